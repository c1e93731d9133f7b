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
    const field = new Field({key: `box.${axis}`, label: `Box from ${axis} to`, kind: "range"}, {
      onEdit: text => this.scene.edit(`box.${axis}`, text), onReset() {}, onForget() {}});
    field.isShown = facts => facts.bodies !== null && (axis === "x" || facts.bodies.dimensions === 2);
    return field;
  }

  update(facts) {
    this.root.hidden = !facts.bodies;
    if (!facts.bodies) return;
    const {count, dimensions, rows, x, y} = facts.bodies;
    const boxes = {...facts, keys: {"box.x": x, "box.y": y}};
    this.box.forEach(box => box.update(boxes));
    this.hint.hidden = count === rows.length;
    this.hint.textContent = `${count} bodies: too many for a table. The scene file has them.`;
    this.add.hidden = !this.hint.hidden;
    this.#facts = facts;
    // What was refused, or is being typed, stays as it is.
    if (!this.problem.hidden) return;
    if (this.table.contains(document.activeElement) && rows.length === this.#rows.length) {
      this.#rows = rows;
      return;
    }
    this.#rows = structuredClone(rows);
    this.#draw(dimensions);
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
        ...cells.map(cell => element("td", {}, cell)), element("td", {}, this.#remover(number)))));
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
      setTimeout(() => this.update(this.scene.facts));
    });
    return input;
  }

  #remover(number) {
    const button = element("button", {type: "button", "aria-label": `Remove body ${number + 1}`}, "×");
    button.addEventListener("click", () => {
      this.#rows.splice(number, 1);
      button.blur();
      this.#draw(this.#facts.bodies.dimensions);
      this.#send();
    });
    return button;
  }

  /** A copy of the last one, beside it. */
  #addRow() {
    const last = this.#rows.at(-1);
    const row = structuredClone(last);
    const gap = Math.ceil(2 * valueOf(last.size) + 1) + 1;
    row.position[0] = String(Math.ceil(valueOf(last.position[0])) + gap);
    row.velocity = row.velocity.map(() => "0");
    row.label = "";
    this.#rows.push(row);
    this.#draw(this.#facts.bodies.dimensions);
    this.#send();
  }

  #send() {
    const {toml, bodies} = this.#facts;
    const head = toml.split("\n").filter(line => line && !line.startsWith("body = "));
    const rows = this.#rows.map(row => bodyText(row, bodies.dimensions));
    this.scene.replace([...head, ...rows, ""].join("\n"), "bodies");
  }

  has(key) {
    return this.box.some(box => box.spec.key === key && !box.root.hidden && !this.root.hidden);
  }

  /** @returns the problems that are not about bodies. */
  say(problems) {
    const boxes = new Map(AXES.map((axis, i) => [`box.${axis}`, this.box[i]]));
    const mine = problems.filter(problem => problem.key === "bodies");
    const ofBox = problems.filter(problem => boxes.has(problem.key));
    for (const [key, box] of boxes) {
      box.say(ofBox.filter(problem => problem.key === key).map(problem => problem.words).join("\n"));
    }
    this.problem.textContent = mine.map(problem => problem.words).join("\n");
    this.problem.hidden = mine.length === 0;
    this.#cells.forEach((cells, number) => cells.forEach(cell => {
      const isWrong = mine.some(({body, property}) =>
        body === number + 1 && property === cell.dataset.property);
      cell.setAttribute("aria-invalid", String(isWrong));
    }));
    return problems.filter(problem => !mine.includes(problem) && !ofBox.includes(problem));
  }
}
