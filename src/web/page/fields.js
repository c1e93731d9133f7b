// The fields of a scene's keys.
// In: what the program says of a scene. Out: edits of its keys; problems beside the fields.

import {approximate, byId, element, lineOf, sayIn} from "./dom.js";
import {wordsOf} from "./program.js";

/** {key, label} and more: `slider` is [minimum, maximum, step], of which the program may allow a part;
 * `kind` is "text" if it is missing; an empty field sets the value `empty`, and null the key's default. */
const FIRST = [
  {key: "digits", label: "Digits of π", slider: [1, 20, 1], kind: "slider"},
  {key: "blue.mass", label: "Blue mass"},
  {key: "red.mass", label: "Red mass"},
  {key: "blue.velocity", label: "Blue velocity", slider: [-2, 2, 0.05], kind: "slider"},
  {key: "red.velocity", label: "Red velocity", slider: [-3, 3, 0.05], kind: "slider"},
  {key: "restitution", label: "Bounciness", slider: [0, 1, 0.01], kind: "slider"}];
const GROUPS = [
  {title: "Diagrams and numbers", fields: [
    {key: "show.panels", label: "Diagrams", kind: "names", choices: "panels"},
    {key: "show.overlays", label: "Numbers and marks", kind: "names", choices: "overlays"},
    {key: "show.loupe", label: "Loupe", hints: ["auto", "stage", "off"], empty: null, of: "line"},
    {key: "show.hits", label: "Hit marks", kind: "flag"},
    {key: "show.title", label: "Title", empty: ""},
    {key: "show.caption", label: "Caption", empty: ""}]},
  {title: "Blocks", fields: [
    {key: "digits", label: "Digits of π"},
    {key: "mass-ratio", label: "Mass ratio"},
    {key: "base", label: "Base", slider: [2, 36, 1]},
    {key: "blue.position", label: "Blue: position", slider: [0.5, 6, 0.05]},
    {key: "red.position", label: "Red: position", slider: [1.5, 12, 0.05]},
    {key: "blue.velocity", label: "Blue: velocity"},
    {key: "red.velocity", label: "Red: velocity"},
    {key: "blue.width", label: "Blue: width", slider: [0.1, 3, 0.05]},
    {key: "red.width", label: "Red: width", slider: [0.1, 3, 0.05]},
    {key: "blocks.restitution", label: "Restitution of blocks", slider: [0, 1, 0.01]},
    {key: "wall.restitution", label: "Restitution of wall", slider: [0, 1, 0.01]},
    {key: "wall.face", label: "Face of the wall"},
    {key: "wall.mass", label: "Mass of the wall"}]},
  {title: "Box", fields: [
    {key: "box.x", label: "x from, to", kind: "range"},
    {key: "box.y", label: "y from, to", kind: "range"}]},
  {title: "Time", fields: [
    {key: "time.from", label: "From", hints: ["0", "turn-0.3"]},
    {key: "time.to", label: "To", hints: ["last+1.5", "turn+0.3", "10"]},
    {key: "time.speed", label: "Speed", slider: [0.05, 4, 0.05]},
    {key: "time.duration", label: "Duration", empty: null},
    {key: "time.slow-motion", label: "Slow motion", hints: ["auto", "turn-0.3:turn+0.3:10"], empty: ""},
    {key: "time.ease", label: "Ease"},
    {key: "time.freeze", label: "Freeze", hints: ["turn:2"], empty: ""},
    {key: "time.hold-start", label: "Hold at start"},
    {key: "time.hold-end", label: "Hold at end"},
    {key: "time.loop", label: "Back and forth", kind: "flag"},
    {key: "time.allow-uncertain", label: "Go on when uncertain", kind: "flag"}]},
  {title: "Picture", fields: [
    {key: "view.theme", label: "Theme", kind: "choice", choices: "themes"},
    {key: "view.size", label: "Size", hints: ["1920x1080", "1280x720", "3840x2160", "1080x1920", "1080x1080"]},
    {key: "view.fps", label: "Frames a second", hints: ["60", "30", "25", "30000/1001"]},
    {key: "view.shutter", label: "Shutter", slider: [0, 1, 0.05]},
    {key: "view.x", label: "View: x from, to", kind: "range"},
    {key: "view.y", label: "View: y from, to", kind: "range"},
    {key: "view.background", label: "Background", hints: ["opaque", "transparent", "#fdf6e3"]}]},
  {title: "Sound", fields: [
    {key: "sound.on", label: "Sound in the film", kind: "flag"}]},
];

/** How many decimals the steps of a slider have. */
const decimalsOf = step => String(step).split(".")[1]?.length ?? 0;

class Field {
  constructor(spec, session, lists) {
    this.spec = spec;
    this.session = session;
    // A key may have a slider and, elsewhere, a field for exact values.
    this.id = `${spec.kind === "slider" ? "slider" : "field"}-${spec.key.replace(/[. ]/g, "-")}`;
    this.problem = element("p", {className: "problem", id: `${this.id}-problem`, hidden: true, role: "alert"});
    this.note = element("p", {className: "hint", hidden: true, role: "status"});
    this.choices = lists[spec.choices];
    const makers = {text: this.makeText, slider: this.makeSliderAlone, choice: this.makeChoice,
      flag: this.makeFlag, names: this.makeNames, range: this.makeRange};
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
  makeLine(onInput, properties) {
    const made = lineOf({onInput, onEscape: () => this.session.forget(this.spec.key)},
      {"aria-describedby": this.problem.id, ...properties});
    made.addEventListener("blur", () => this.refresh());
    this.inputs.push(made);
    return made;
  }

  makeRow(...values) {
    return element("div", {className: "field"},
      element("label", {htmlFor: this.id}, this.spec.label),
      element("span", {className: "value"}, ...values), this.note, this.problem);
  }

  makeText() {
    const main = this.makeLine(() => this.typed(main.value), {id: this.id});
    const {slider, hints, empty} = this.spec;
    const values = [main];
    if (empty !== undefined) main.placeholder = "default";
    if (hints) {
      main.setAttribute("list", `${this.id}-hints`);
      values.push(element("datalist", {id: `${this.id}-hints`}, ...hints.map(value => element("option", {value}))));
    }
    if (slider) values.unshift(this.makeSlider(value => main.value = value));
    this.showValue = facts => {
      if (document.activeElement !== main) main.value = this.textOf(facts);
      if (slider) this.showSlider(facts);
    };
    return this.makeRow(...values);
  }

  makeSliderAlone() {
    const output = element("output", {htmlFor: this.id});
    const slider = this.makeSlider(value => output.value = value);
    slider.id = this.id;
    slider.removeAttribute("aria-label");
    this.showValue = facts => {
      output.value = this.textOf(facts);
      this.showSlider(facts);
    };
    return this.makeRow(slider, output);
  }

  makeSlider(show) {
    const [min, max, step] = this.spec.slider;
    this.slider = element("input", {type: "range", min, max, step, "aria-label": `${this.spec.label}, slider`,
      "aria-describedby": this.problem.id});
    this.slider.addEventListener("input", () => {
      const value = this.valueOfSlider();
      show(value);
      this.edited(value);
    });
    return this.slider;
  }

  /** As few decimals as its steps have, but not beyond its ends. */
  valueOfSlider() {
    const [low, high] = this.ends;
    const rounded = Number(Number(this.slider.value).toFixed(decimalsOf(this.spec.slider[2])));
    return String(Math.min(Math.max(rounded, low), high));
  }

  /** The slider ends where the scene does. */
  showSlider(facts) {
    const [min, max, step] = this.spec.slider;
    const [low, high] = facts.ranges?.[this.spec.key] ?? [min, max];
    this.ends = [Math.max(min, low), Math.min(max, high)];
    if (this.slider.matches(":active")) return;
    // Steps are counted from the minimum.
    this.slider.min = Math.floor(this.ends[0] / step + 1e-9) * step;
    this.slider.max = Math.ceil(this.ends[1] / step - 1e-9) * step;
    this.slider.disabled = !(this.ends[0] < this.ends[1]);
    this.slider.value = approximate(this.textOf(facts));
  }

  makeChoice() {
    const select = element("select", {id: this.id, "aria-describedby": this.problem.id},
      ...this.choices.map(name => element("option", {}, name)));
    this.inputs.push(select);
    select.addEventListener("change", () => this.edited(select.value));
    this.showValue = facts => select.value = this.textOf(facts);
    return this.makeRow(select);
  }

  makeFlag() {
    const box = this.makeInput({type: "checkbox", id: this.id});
    box.addEventListener("change", () => this.edited(String(box.checked)));
    this.showValue = facts => box.checked = this.textOf(facts) === "true";
    return this.makeRow(box);
  }

  /** In the order in which they are chosen. */
  makeNames() {
    let chosen = [];
    this.boxes = this.choices.map(name => {
      const box = this.makeInput({type: "checkbox", value: name});
      box.addEventListener("change", () => {
        chosen = chosen.filter(other => other !== name);
        if (box.checked) chosen.push(name);
        this.edited(chosen.join(","));
      });
      return box;
    });
    this.reasons = element("p", {className: "hint", hidden: true});
    this.showValue = facts => {
      chosen = facts.keys[this.spec.key].filter(name => this.choices.includes(name));
      for (const box of this.boxes) box.checked = chosen.includes(box.value);
    };
    return element("fieldset", {className: "field list"}, element("legend", {}, this.spec.label),
      element("span", {className: "names"},
        ...this.boxes.map(box => element("label", {}, box, box.value))), this.reasons, this.note, this.problem);
  }

  /** @param reasons  by name, why it cannot be added */
  disable(reasons = {}) {
    const byReason = new Map();
    for (const box of this.boxes) {
      const reason = box.checked ? undefined : reasons[box.value];
      box.disabled = reason !== undefined;
      box.parentElement.title = reason ?? "";
      if (reason) byReason.set(reason, [...(byReason.get(reason) ?? []), box.value]);
    }
    sayIn(this.reasons, [...byReason].map(([reason, names]) => `${names.join(", ")}: ${reason}.`).join("\n"));
  }

  makeRange() {
    const onInput = () => this.typed(ends.map(one => one.value).join("\t"));
    const ends = ["low", "high"].map((end, i) => this.makeLine(onInput,
      {id: i ? `${this.id}-high` : this.id, "aria-label": `${this.spec.label}, ${end} end`}));
    this.showValue = facts => ends.forEach((end, i) => {
      if (document.activeElement !== end) end.value = facts.keys[this.spec.key][i];
    });
    return this.makeRow(...ends);
  }

  /** What the program says of the key; null if the scene has no such key. */
  textOf({keys}) {
    if (this.spec.key === "restitution") {
      const {"blocks.restitution": blocks, "wall.restitution": wall} = keys;
      return blocks?.[0] === wall?.[0] ? blocks?.[0] ?? null : `${blocks}, ${wall}`;
    }
    return keys[this.spec.key]?.join(", ") ?? null;
  }

  typed(text) {
    this.edited(text, true);
  }
  edited(text, isTyped = false) {
    // Tabs separate the values of a list, line breaks the keys.
    const value = this.spec.kind === "range" ? text : text.replace(/[\t\n\r]+/g, " ");
    const {key, empty} = this.spec;
    this.session.edit(key, value === "" && empty !== undefined ? empty : value, isTyped);
  }

  isShown(facts) {
    const {of} = this.spec;
    if (of === "blocks" && facts.bodies) return false;
    if (of === "line" && facts.bodies?.dimensions === 2) return false;
    return this.textOf(facts) !== null;
  }

  update(facts) {
    this.facts = facts;
    this.root.hidden = !this.isShown(facts);
    this.refresh();
  }

  /** Shows the value of the scene, unless a newer one was refused or is still to be taken. */
  refresh() {
    const {key} = this.spec;
    if (!this.facts || this.root.hidden || this.session.problemsOf(key).length > 0) return;
    if (!this.session.isWaiting(key)) this.showValue(this.facts);
  }

  /** @returns whether something is wrong with what was typed */
  say() {
    const {key, kind} = this.spec;
    const say = (target, problems) =>
      sayIn(target, problems.map(problem => wordsOf(problem, key)).join("\n"));
    const problems = this.root.hidden ? [] : this.session.problemsOf(key);
    // A slider alone cannot be wrong; the field for exact values says it.
    say(this.problem, kind === "slider" ? [] : problems);
    say(this.note, this.session.reasonsAgainst(key));
    for (const input of this.inputs) input.setAttribute("aria-invalid", String(problems.length > 0));
    this.refresh();
    return problems.length > 0;
  }
}

/** All fields: the first ones, and groups of others in the element "more". */
export class Fields {
  #fields;
  #groups;

  constructor(session, lists) {
    const make = of => spec => new Field({of, ...spec}, session, lists);
    const first = FIRST.map(make("blocks"));
    byId("first").append(...first.map(field => field.root));
    this.#groups = GROUPS.map(({title, fields}) => {
      const made = fields.map(make(title === "Blocks" ? "blocks" : ""));
      const root = element("details", {className: "group"}, element("summary", {}, title),
        ...made.map(field => field.root));
      return {root, fields: made};
    });
    byId("groups").append(...this.#groups.map(({root}) => root));
    this.#fields = [...first, ...this.#groups.flatMap(({fields}) => fields)];
  }

  labelOf(key) {
    return this.#fields.find(field => field.spec.key === key)?.spec.label;
  }

  update(facts) {
    const {x, y, dimensions} = facts.bodies ?? {};
    const keys = {...facts.keys, ...x && {"box.x": x}, ...dimensions === 2 && {"box.y": y}};
    for (const field of this.#fields) field.update({...facts, keys});
    for (const {root, fields} of this.#groups) root.hidden = fields.every(field => field.root.hidden);
  }

  /** @param choices  by key and name, why it cannot be added */
  disable(choices) {
    for (const field of this.#fields) {
      if (field.boxes) field.disable(choices[field.spec.key]);
    }
  }

  /** Says beside each field what is wrong with it. @returns the keys for which there is a field */
  say() {
    const wrong = this.#fields.filter(field => field.say());
    for (const field of wrong) {
      for (let group = field.root.closest("details"); group; group = group.parentElement.closest("details")) {
        group.open = true;
      }
    }
    return wrong.map(field => field.spec.key);
  }
}
