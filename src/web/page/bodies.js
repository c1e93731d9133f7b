// The table of a scene's bodies.
// In: what the program says of a scene with bodies. Out: its text with other bodies.

const AXES = ["x", "y"];

/** A string of TOML; those of JSON are such strings. */
const quoted = text => JSON.stringify(text);
const vector = texts =>
  texts.length === 1 ? quoted(texts[0]) : `[${texts.map(quoted).join(", ")}]`;

function bodyText(row, dimensions) {
  const lines = ["[[body]]", `mass = ${quoted(row.mass)}`, `position = ${vector(row.position)}`,
    `velocity = ${vector(row.velocity)}`,
    `${dimensions === 1 ? "width" : "radius"} = ${quoted(row.size)}`];
  if (row.color) lines.push(`color = ${quoted(row.color)}`);
  if (row.label) lines.push(`label = ${quoted(row.label)}`);
  if (row.path) lines.push("path = true");
  return lines.join("\n");
}

class Bodies {
  #rows = [];
  #facts = null;
  #cells = [];

  constructor(scene, before) {
    this.scene = scene;
    this.table = element("table");
    this.problem = element("p", {className: "problem", id: "bodies-problem", hidden: true});
    this.problem.setAttribute("role", "alert");
    this.hint = element("p", {className: "hint"});
    this.box = AXES.map(axis => this.#makeBox(axis));
    this.add = element("button", {type: "button"}, "Add a body");
    this.add.addEventListener("click", () => this.#addRow());
    this.root = element("details", {className: "group", id: "bodies-group", open: true, hidden: true},
      element("summary", {}, "Bodies"), ...this.box.map(box => box.root), this.hint,
      element("div", {className: "bodies"}, this.table), this.problem, this.add);
    before.before(this.root);
  }

  #makeBox(axis) {
    const key = `box.${axis}`;
    const field = new Field({key, label: `Box: ${axis} from, to`, kind: "range"}, {scene: this.scene});
    field.isShown = facts => facts.bodies !== null && (axis === "x" || facts.bodies.dimensions === 2);
    return field;
  }

  update(facts) {
    this.root.hidden = !facts.bodies;
    this.#facts = facts.bodies ? facts : null;
    if (!facts.bodies) return;
    const {count, dimensions, rows, x, y} = facts.bodies;
    const boxes = {...facts, keys: {"box.x": x, "box.y": y}};
    this.box.forEach(box => box.update(boxes));
    this.hint.hidden = count === rows.length;
    this.hint.textContent = `${count} bodies: too many for a table. The scene file has them.`;
    this.add.hidden = this.table.hidden = !this.hint.hidden;
    // What was refused, or is being typed, stays as it is.
    if (!this.problem.hidden || this.scene.isWaiting("bodies")) return;
    const isUsed = this.table.contains(document.activeElement) && rows.length === this.#rows.length;
    this.#rows = structuredClone(rows);
    if (!isUsed) this.#draw(dimensions);
  }

  #draw(dimensions) {
    const axes = AXES.slice(0, dimensions);
    const suffix = axis => dimensions === 1 ? "" : ` ${axis}`;
    const columns = [
      {name: "mass", property: "mass"},
      ...axes.map((axis, i) => ({name: `position${suffix(axis)}`, property: "position", i})),
      ...axes.map((axis, i) => ({name: `velocity${suffix(axis)}`, property: "velocity", i})),
      {name: dimensions === 1 ? "width" : "radius", property: "size"},
      {name: "label", property: "label"}, {name: "colour", property: "color"}];
    this.#cells = this.#rows.map((row, number) =>
      columns.map(column => this.#cell(row, number, column)));
    this.table.replaceChildren(
      element("tr", {}, element("th", {}, ""),
        ...columns.map(({name}) => element("th", {scope: "col"}, name)), element("td")),
      ...this.#cells.map((cells, number) => element("tr", {},
        element("th", {scope: "row"}, String(number + 1)),
        ...cells.map(cell => element("td", {}, cell)),
        element("td", {}, ...this.#rows.length > 1 ? [this.#remover(number)] : []))));
  }

  #cell(row, number, {name, property, i}) {
    const value = i === undefined ? row[property] : row[property][i];
    const input = element("input", {type: "text", spellcheck: false, autocapitalize: "off",
      value: property === "label" || property === "color" ? value : readable(value),
      "aria-label": `Body ${number + 1}, ${name}`, "aria-describedby": "bodies-problem"});
    input.dataset.property = {size: this.#facts.bodies.dimensions === 1 ? "width" : "radius"}[property]
      ?? property;
    input.addEventListener("input", () => {
      const target = this.#rows[number];
      if (i === undefined) target[property] = input.value;
      else target[property][i] = input.value;
      this.#send();
    });
    input.addEventListener("blur", () => {
      setTimeout(() => this.#facts && this.update(this.#facts), 300);
    });
    return input;
  }

  #remover(number) {
    const button = element("button", {type: "button", "aria-label": `Remove body ${number + 1}`}, "×");
    button.addEventListener("click", () => {
      this.#rows.splice(number, 1);
      this.#draw(this.#facts.bodies.dimensions);
      this.add.focus();
      this.#send();
    });
    return button;
  }

  /** A copy of the last one, beside it. */
  #addRow() {
    const last = this.#rows.at(-1);
    const row = structuredClone(last);
    const gap = Math.ceil(2 * approximateNumber(last.size) + 1) + 1;
    row.position[0] = String(Math.ceil(approximateNumber(last.position[0])) + gap);
    row.velocity = row.velocity.map(() => "0");
    row.label = "";
    this.#rows.push(row);
    this.#draw(this.#facts.bodies.dimensions);
    this.#cells.at(-1)[0].focus();
    this.#send();
  }

  #send() {
    const rows = this.#rows.map(row => bodyText(row, this.#facts.bodies.dimensions));
    this.scene.replace(({toml}) => {
      const head = toml.split("\n").filter(line => line && !line.startsWith("body = "));
      return [...head, ...rows, ""].join("\n");
    }, "bodies");
  }

  has(key) {
    return this.box.some(box => box.spec.key === key && !box.root.hidden && !this.root.hidden);
  }

  labelOf(key) {
    return this.box.find(box => box.spec.key === key)?.spec.label;
  }

  /** @returns the problems that are not about bodies. */
  say(problems) {
    const boxes = new Map(AXES.map((axis, i) => [`box.${axis}`, this.box[i]]));
    const mine = problems.filter(problem => problem.key === "bodies");
    const ofBox = problems.filter(problem => boxes.has(problem.key));
    for (const [key, box] of boxes) {
      box.say(ofBox.filter(problem => problem.key === key).map(problem => problem.words).join("\n"));
    }
    const wasWrong = !this.problem.hidden;
    sayIn(this.problem, mine.map(problem => problem.words).join("\n"));
    if (wasWrong && mine.length === 0 && this.#facts) this.update(this.#facts);
    this.#cells.forEach((cells, number) => cells.forEach(cell => {
      const isWrong = mine.some(({body, property}) =>
        body === number + 1 && property === cell.dataset.property);
      cell.setAttribute("aria-invalid", String(isWrong));
    }));
    return problems.filter(problem => !mine.includes(problem) && !ofBox.includes(problem));
  }
}
