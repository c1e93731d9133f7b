// The fields of a scene's keys.
// In: what the program says of a scene. Out: edits of its keys; problems beside the fields.

/** {key, label} and more: `slider` is [minimum, maximum, step]; `kind` is "text" if it is missing; an
 * empty field sets the value `empty`, and null removes the key from the scene. */
const GROUPS = [
  {title: "Blocks", isOpen: true, of: "blocks", fields: [
    {key: "digits", label: "Digits of π", slider: [1, 20, 1]},
    {key: "mass-ratio", label: "Mass ratio"},
    {key: "base", label: "Base", slider: [2, 36, 1]},
    {key: "blue.mass", label: "Blue: mass"},
    {key: "red.mass", label: "Red: mass"},
    {key: "blue.position", label: "Blue: position", slider: [0.5, 6, 0.05]},
    {key: "red.position", label: "Red: position", slider: [1.5, 12, 0.05]},
    {key: "blue.velocity", label: "Blue: velocity", slider: [-2, 2, 0.05]},
    {key: "red.velocity", label: "Red: velocity", slider: [-3, 3, 0.05]},
    {key: "blue.width", label: "Blue: width", slider: [0.1, 3, 0.05]},
    {key: "red.width", label: "Red: width", slider: [0.1, 3, 0.05]},
    {key: "blocks.restitution", label: "Restitution of blocks", slider: [0, 1, 0.01]},
    {key: "wall.restitution", label: "Restitution of wall", slider: [0, 1, 0.01]},
    {key: "wall.face", label: "Face of the wall"},
    {key: "wall.mass", label: "Mass of the wall"}]},
  {title: "Overlays and diagrams", isOpen: true, fields: [
    {key: "view.theme", label: "Theme", kind: "choice", choices: "themes"},
    {key: "show.overlays", label: "Overlays", kind: "names", choices: "overlays"},
    {key: "show.panels", label: "Diagrams", kind: "names", choices: "panels"},
    {key: "show.loupe", label: "Loupe", hints: ["auto", "stage", "off"], empty: null, of: "line"},
    {key: "show.hits", label: "Hit marks", kind: "flag"},
    {key: "show.title", label: "Title", empty: ""},
    {key: "show.caption", label: "Caption", empty: ""}]},
  {title: "Time", fields: [
    {key: "time.from", label: "From", hints: ["0", "turn-0.3"]},
    {key: "time.to", label: "To", hints: ["last+1.5", "turn+0.3", "10"]},
    {key: "time.speed", label: "Speed", slider: [0.05, 4, 0.05]},
    {key: "time.duration", label: "Duration", empty: null},
    {key: "time.slow-motion", label: "Slow motion", hints: ["auto", "turn-0.3:turn+0.3:10"],
     empty: ""},
    {key: "time.ease", label: "Ease"},
    {key: "time.freeze", label: "Freeze", hints: ["turn:2"], empty: ""},
    {key: "time.hold-start", label: "Hold at start"},
    {key: "time.hold-end", label: "Hold at end"},
    {key: "time.loop", label: "Back and forth", kind: "flag"},
    {key: "time.allow-uncertain", label: "Go on when uncertain", kind: "flag"}]},
  {title: "Picture", fields: [
    {key: "view.size", label: "Size", hints: ["1920x1080", "1280x720", "3840x2160", "1080x1920",
      "1080x1080"]},
    {key: "view.fps", label: "Frames a second", hints: ["60", "30", "25", "30000/1001"]},
    {key: "view.shutter", label: "Shutter", slider: [0, 1, 0.05]},
    {key: "view.x", label: "View: x from, to", kind: "range"},
    {key: "view.y", label: "View: y from, to", kind: "range"},
    {key: "view.background", label: "Background", hints: ["opaque", "transparent", "#fdf6e3"]}]},
];

/** Makes an element: element("p", {className: "hint"}, "text", child). */
function element(name, properties = {}, ...children) {
  const made = document.createElement(name);
  for (const [property, value] of Object.entries(properties)) {
    if (property.includes("-")) made.setAttribute(property, value);
    else made[property] = value;
  }
  made.append(...children);
  return made;
}

/** Shows words; writes them only if they differ, so that they are read out once. */
function sayIn(target, words) {
  if (target.textContent !== words) target.textContent = words;
  target.hidden = words === "";
}

/** "5/2" as "2.5"; a number that is no decimal stays. */
function readable(number) {
  const [, sign, numerator, denominator] = number.match(/^(-?)(\d+)\/(\d+)$/) ?? [];
  if (denominator === undefined) return number;
  let rest = BigInt(denominator);
  let places = 0;
  for (const prime of [2n, 5n]) {
    let times = 0;
    for (; rest % prime === 0n; rest /= prime) ++times;
    places = Math.max(places, times);
  }
  if (rest !== 1n || places > 20) return number;
  const digits = (BigInt(numerator) * 10n ** BigInt(places) / BigInt(denominator)).toString()
    .padStart(places + 1, "0");
  return `${sign}${digits.slice(0, -places)}.${digits.slice(-places)}`;
}

/** Near enough for a slider. */
function approximateNumber(text) {
  const [above, below = "1"] = text.split("/");
  return Number(above) / Number(below);
}

/** Keys whose texts are not numbers, whatever they look like. */
const WORDS = ["show.title", "show.caption"];

/** What the program says of a key, as a field shows it; null if the scene has no such key. */
function textOf(key, facts) {
  const keys = facts.keys;
  if (facts.kind === "scene" && facts.bodies === null) {
    if (key === "digits") return facts.digits === null ? "" : String(facts.digits);
    if (key === "wall.mass") return "inf";
    if (key === "mass-ratio") {
      return facts.digits > 4 ? `${Number(keys.base[0]) ** 2}^${facts.digits - 1}`
        : readable(facts.massRatio);
    }
  }
  if (WORDS.includes(key)) return keys[key]?.[0] ?? null;
  return keys[key]?.map(readable).join(", ") ?? null;
}

class Field {
  constructor(spec, {scene, lists}) {
    Object.assign(this, {spec, scene});
    this.id = `field-${spec.key.replace(".", "-")}`;
    this.problem = element("p", {className: "problem", id: `${this.id}-problem`, hidden: true});
    this.problem.setAttribute("role", "alert");
    this.choices = typeof spec.choices === "string" ? lists[spec.choices] : spec.choices;
    const makers = {text: this.makeText, choice: this.makeChoice, flag: this.makeFlag,
      names: this.makeNames, range: this.makeRange};
    this.root = makers[spec.kind ?? "text"].call(this);
    this.root.dataset.key = spec.key;
  }

  /** Inputs that a problem makes invalid. */
  inputs = [];

  makeInput(properties) {
    const made = element("input", {"aria-describedby": this.problem.id, ...properties});
    this.inputs.push(made);
    return made;
  }

  makeRow(...values) {
    return element("div", {className: "field"},
      element("label", {htmlFor: this.id}, this.spec.label),
      element("span", {className: "value"}, ...values), this.problem);
  }

  makeText() {
    const main = this.makeInput({type: "text", id: this.id, spellcheck: false, autocapitalize: "off"});
    const {slider, hints, empty} = this.spec;
    const values = [main];
    if (empty !== undefined) main.placeholder = "default";
    if (hints) {
      main.setAttribute("list", `${this.id}-hints`);
      values.push(element("datalist", {id: `${this.id}-hints`},
        ...hints.map(value => element("option", {value}))));
    }
    main.addEventListener("input", () => this.edited(main.value));
    this.listenToLeaving(main);
    if (slider) values.unshift(this.makeSlider(main));
    this.showValue = facts => {
      const value = textOf(this.spec.key, facts);
      if (document.activeElement !== main) main.value = value;
      if (this.sliderInput && document.activeElement !== this.sliderInput) this.sliderInput.value = approximateNumber(value);
    };
    return this.makeRow(...values);
  }

  listenToLeaving(input) {
    input.addEventListener("keydown", event => {
      if (event.key === "Escape") this.forget();
    });
    input.addEventListener("blur", () => this.refresh());
  }

  /** Gives up a value that was refused. */
  forget() {
    document.activeElement.blur();
    this.scene.forget(this.spec.key);
    this.say("");
  }

  makeSlider(main) {
    const [min, max, step] = this.spec.slider;
    const decimals = String(step).split(".")[1]?.length ?? 0;
    this.sliderInput = element("input", {type: "range", min, max, step,
      "aria-label": `${this.spec.label}, slider`});
    this.sliderInput.addEventListener("input", () => {
      main.value = String(Number(Number(this.sliderInput.value).toFixed(decimals)));
      this.edited(main.value);
    });
    return this.sliderInput;
  }

  makeChoice() {
    const select = element("select", {id: this.id, "aria-describedby": this.problem.id},
      ...this.choices.map(name => element("option", {}, name)));
    this.inputs.push(select);
    select.addEventListener("change", () => this.edited(select.value));
    this.showValue = facts => select.value = textOf(this.spec.key, facts);
    return this.makeRow(select);
  }

  makeFlag() {
    const box = this.makeInput({type: "checkbox", id: this.id});
    box.addEventListener("change", () => this.edited(String(box.checked)));
    this.showValue = facts => box.checked = textOf(this.spec.key, facts) === "true";
    return this.makeRow(box);
  }

  /** In the order in which they are chosen. */
  makeNames() {
    const chosen = [];
    const boxes = this.choices.map(name => {
      const box = this.makeInput({type: "checkbox", value: name});
      box.addEventListener("change", () => {
        const next = chosen.filter(other => other !== name);
        if (box.checked) next.push(name);
        chosen.splice(0, chosen.length, ...next);
        this.edited(next.join(","));
      });
      return box;
    });
    this.showValue = facts => {
      const names = facts.keys[this.spec.key].filter(name => this.choices.includes(name));
      chosen.splice(0, chosen.length, ...names);
      for (const box of boxes) box.checked = chosen.includes(box.value);
    };
    return element("fieldset", {className: "field list"},
      element("legend", {}, this.spec.label),
      element("span", {className: "names"},
        ...boxes.map(box => element("label", {}, box, box.value))), this.problem);
  }

  makeRange() {
    const ends = ["low", "high"].map((end, i) => this.makeInput({type: "text", id: i ? `${this.id}-high`
      : this.id, spellcheck: false, autocapitalize: "off", "aria-label": `${this.spec.label}, ${end} end`}));
    for (const end of ends) {
      end.addEventListener("input", () => this.edited(ends.map(one => one.value).join("\t")));
      this.listenToLeaving(end);
    }
    this.showValue = facts => ends.forEach((end, i) => {
      if (document.activeElement !== end) end.value = readable(facts.keys[this.spec.key][i]);
    });
    return this.makeRow(...ends);
  }

  edited(text) {
    // Tabs separate the values of a list, line breaks the keys.
    const value = this.spec.kind === "range" ? text : text.replace(/[\t\n\r]+/g, " ");
    const {key, empty} = this.spec;
    if (value !== "" || empty === undefined) this.scene.edit(key, value);
    else if (empty === null) this.scene.reset(key);
    else this.scene.edit(key, empty);
  }

  isShown(facts) {
    const {key, of} = this.spec;
    if (of === "blocks" && facts.bodies) return false;
    if (of === "line" && facts.bodies?.dimensions === 2) return false;
    return textOf(key, facts) !== null;
  }

  update(facts) {
    this.facts = facts;
    this.root.hidden = !this.isShown(facts);
    this.refresh();
  }

  /** Shows the value of the scene, unless a newer one was refused or is still to be taken. */
  refresh() {
    const isNewer = !this.problem.hidden || this.scene.isWaiting(this.spec.key);
    if (this.facts && !this.root.hidden && !isNewer) this.showValue(this.facts);
  }

  /** @param words  of the program; empty if the value is right */
  say(words) {
    const wasWrong = !this.problem.hidden;
    sayIn(this.problem, words);
    for (const input of this.inputs) input.setAttribute("aria-invalid", String(words !== ""));
    if (wasWrong) this.refresh();
  }
}

/** All fields, in groups before the element `before`. */
class Fields {
  #fields = new Map();
  #groups = [];

  constructor(scene, lists, before) {
    for (const group of GROUPS) {
      const fields = group.fields.map(spec => new Field({of: group.of, ...spec}, {scene, lists}));
      for (const field of fields) this.#fields.set(field.spec.key, field);
      const root = element("details", {className: "group", open: !!group.isOpen},
        element("summary", {}, group.title), ...fields.map(field => field.root));
      this.#groups.push({root, fields});
      before.before(root);
    }
  }

  labelOf(key) {
    return this.#fields.get(key)?.spec.label;
  }

  update(facts) {
    for (const field of this.#fields.values()) field.update(facts);
    for (const {root, fields} of this.#groups) {
      root.hidden = fields.every(field => field.root.hidden);
    }
  }

  has(key) {
    const field = this.#fields.get(key);
    return field !== undefined && !field.root.hidden;
  }

  /** @returns the problems that no field is there for. */
  say(problems) {
    const words = new Map();
    const others = [];
    for (const problem of problems) {
      if (this.has(problem.key)) {
        words.set(problem.key, [...(words.get(problem.key) ?? []), problem.words]);
        this.#fields.get(problem.key).root.closest("details").open = true;
      } else {
        others.push(problem);
      }
    }
    for (const [key, field] of this.#fields) field.say((words.get(key) ?? []).join("\n"));
    return others;
  }
}
