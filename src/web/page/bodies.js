// The table of a scene's bodies.
// In: what the program says of a scene with bodies. Out: edits of keys such as "body 2.mass".

import {byId, element, lineOf, sayIn} from "./dom.js";
import {wordsOf} from "./program.js";

const AXES = ["x", "y"];

/** What a row has; `i` is the index in a vector.
 * @returns {{name: string, property: string, i?: number}[]} */
function columnsOf(dimensions) {
  const axes = AXES.slice(0, dimensions);
  const vector = property => axes.map((axis, i) =>
    ({name: dimensions === 1 ? property : `${property} ${axis}`, property, i}));
  return [{name: "mass", property: "mass"}, ...vector("position"), ...vector("velocity"),
    {name: dimensions === 1 ? "width" : "radius", property: "size"},
    {name: "label", property: "label"}, {name: "colour", property: "color"}];
}

export class Bodies {
  #session;
  #facts = null;
  #room = null;
  /** Whether Add was pressed before the program said where there is room. */
  #isAdding = false;
  #cells = [];
  #table = element("table");
  #problem = element("p", {className: "problem", id: "bodies-problem", hidden: true, role: "alert"});
  #hint = element("p", {className: "hint"});
  #add = element("button", {type: "button", id: "add-body"}, "Add a body");

  constructor(session) {
    this.#session = session;
    this.#add.addEventListener("click", () => this.#addRow());
    byId("bodies").append(this.#hint, element("div", {className: "bodies"}, this.#table), this.#problem, this.#add);
  }

  update(facts) {
    byId("bodies").hidden = !facts.bodies;
    this.#facts = facts.bodies;
    if (!facts.bodies) {
      this.#cells = [];
      return;
    }
    const {count, rows} = facts.bodies;
    const isListed = count === rows.length;
    this.#hint.hidden = isListed;
    this.#hint.textContent = `${count} bodies: too many for a table. The scene file has them.`;
    this.#table.hidden = !isListed;
    this.#add.hidden = !isListed;
    // What is being typed, or was refused, stays as it is.
    const isWaiting = this.#session.refusedKeys.some(key => key.startsWith("body "));
    if (this.#cells.length === rows.length && (isWaiting || this.#table.contains(document.activeElement))) return;
    this.#draw(facts.bodies);
  }

  /** @param room  a row for one more body, where it has the most room; null if there is none, undefined
   *   while the program has not said it */
  setRoom(room) {
    this.#room = room;
    if (room === undefined) {
      this.#isAdding = false;
      return;
    }
    this.#add.disabled = !room;
    this.#add.title = room ? "" : "There is no room for another one.";
    if (this.#isAdding) this.#addRow();
  }

  #draw({dimensions, rows}) {
    const columns = columnsOf(dimensions);
    this.#cells = rows.map((row, i) => columns.map(column => this.#cell(row, i + 1, column)));
    this.#table.replaceChildren(
      element("tr", {}, element("th"), element("td"), ...columns.map(({name}) => element("th", {scope: "col"}, name))),
      ...this.#cells.map((cells, i) => element("tr", {}, element("th", {scope: "row"}, String(i + 1)),
        element("td", {}, ...rows.length > 1 ? [this.#remover(i + 1)] : []),
        ...cells.map(cell => element("td", {}, cell)))));
  }

  /** @param {{name: string, property: string, i?: number}} column */
  #cell(row, number, column) {
    const {name, property, i} = column;
    const value = i === undefined ? row[property] : row[property][i];
    const key = () => `body ${number}.${this.#keyOf(property)}`;
    const onInput = () => {
      const cells = this.#cells[number - 1].filter(cell => cell.dataset.property === property);
      const words = cells.map(cell => cell.value.replace(/[\t\n\r]+/g, " ")).join("\t");
      this.#session.edit(key(), words, true);
    };
    const input = lineOf({onInput, onEscape: () => this.#session.forget(key())},
      {value, "aria-label": `Body ${number}, ${name}`, "aria-describedby": "bodies-problem"});
    input.dataset.property = property;
    input.addEventListener("blur", () => {
      setTimeout(() => this.#facts && this.update({bodies: this.#facts}), 300);
    });
    return input;
  }
  #keyOf(property) {
    return property === "size" ? this.#facts.dimensions === 1 ? "width" : "radius" : property;
  }

  #remover(number) {
    const button = element("button", {type: "button", "aria-label": `Remove body ${number}`}, "×");
    button.addEventListener("click", () => {
      this.#add.focus();
      this.#session.edit(`body ${number}`, null);
    });
    return button;
  }

  /** Where there is the most room. */
  #addRow() {
    const {count} = this.#facts;
    const room = this.#room;
    this.#isAdding = room === undefined;
    if (!room) return;
    for (const property of ["position", "velocity", "size", "mass"]) {
      this.#session.edit(`body ${count + 1}.${this.#keyOf(property)}`, [room[property]].flat().join("\t"));
    }
  }

  /** Says what is wrong with the cells. @returns the keys for which there is a cell */
  say() {
    const session = this.#session;
    const wrong = this.#facts && !this.#table.hidden ? session.refusedKeys.filter(key => key.startsWith("body ")) : [];
    sayIn(this.#problem, wrong.flatMap(key => session.problemsOf(key).map(problem => wordsOf(problem))).join("\n"));
    this.#cells.forEach((cells, i) => cells.forEach(cell => {
      const isWrong = wrong.includes(`body ${i + 1}.${this.#keyOf(cell.dataset.property)}`);
      cell.setAttribute("aria-invalid", String(isWrong));
    }));
    if (wrong.length === 0 && this.#facts) this.update({bodies: this.#facts});
    return wrong;
  }
}
