const by_id = id => document.getElementById(id);
const filter = by_id("filter"), refused = by_id("refused"), boxes = by_id("boxes");
const frames = [...document.querySelectorAll(".frame")];
let frame = frames[0];  // the one that keys are for
function update() {
  for (const section of document.querySelectorAll("section[class], li")) {
    const name = section.querySelector("h2, b").textContent.toLowerCase();
    const matches = name.includes(filter.value.toLowerCase());
    section.hidden = !matches || (refused.checked && !section.classList.contains("refused"));
  }
  document.body.dataset.mode = document.querySelector("[name=mode]:checked").value;
  document.body.classList.toggle("no-boxes", !boxes.checked);
  const names = [...document.querySelectorAll(".accept:checked")].map(box => box.value + "\n");
  by_id("names").value = names.join("");
  by_id("download").href = "data:text/plain;charset=utf-8," + encodeURIComponent(names.join(""));
  for (const one of frames) view(one, ...one.at);
}
document.addEventListener("change", update);
filter.addEventListener("input", update);
// The divide is above the middle of the slider's thumb, which is 1rem wide. At either end of the
// slider one picture is seen whole.
function split_of(percent) {
  return percent % 100 == 0 ? percent + "%" : `calc(.5rem + (100% - 1rem) * ${percent / 100})`;
}
for (const slider of document.querySelectorAll("input[type=range]")) {
  slider.addEventListener("input", () =>
    slider.previousElementSibling.style.setProperty("--split", split_of(slider.value)));
}
// Reduced pictures are smoothed, since some of their pixels would not be seen otherwise.
function mark_enlarged() {
  for (const image of document.querySelectorAll(".pane img")) {
    const zoom = devicePixelRatio * visualViewport.scale * (image.closest(".frame").zoom);
    image.classList.toggle("enlarged", image.clientWidth * zoom > image.getAttribute("width"));
  }
}
for (const target of [window, visualViewport]) target.addEventListener("resize", mark_enlarged);
const sizes = new ResizeObserver(changed => changed.forEach(({ target }) => view(target, ...target.at)));
for (const one of frames) sizes.observe(one);
// Shows a frame so many times as large, this point of the pane, from 0 to 1, in its middle.
function view(one, zoom, x = .5, y = .5) {
  const pane = one.querySelector(".pane");
  one.at = [zoom, x, y];
  one.zoom = Math.max(1, Math.min(zoom, 32 * one.dataset.width / pane.clientWidth || 1));
  const shift = (at, size) => Math.min(0, Math.max(size * (1 - one.zoom), size * (.5 - at * one.zoom)));
  one.shift = [shift(x, pane.clientWidth), shift(y, pane.clientHeight)];
  one.style.setProperty("--x", one.shift[0] + "px");
  one.style.setProperty("--y", one.shift[1] + "px");
  one.style.setProperty("--zoom", one.zoom);
  one.classList.toggle("zoomed", one.zoom > 1);
  mark_enlarged();
}
// Zooms by a factor; the middle moves by so many pixels.
function change(factor, x = 0, y = 0) {
  const pane = frame.querySelector(".pane");
  view(frame, frame.zoom * factor, (pane.clientWidth / 2 + x - frame.shift[0]) / frame.zoom / pane.clientWidth,
       (pane.clientHeight / 2 + y - frame.shift[1]) / frame.zoom / pane.clientHeight);
}
let place = -1;  // of the change that is shown
function jump(step) {
  const changes = frames.filter(one => one.checkVisibility()).flatMap(one => {
    const found = [...one.querySelector("svg").querySelectorAll(".change")];
    return found.length ? found.map((rect, i) => [one, rect, i]) : [[one]];
  });
  if (!changes.length) return;
  place = (Math.max(place, step < 0 ? 0 : -1) + step + changes.length) % changes.length;
  const [one, rect, i] = changes[place];
  frame = one;
  for (const old of document.querySelectorAll(".current")) old.classList.remove("current");
  one.scrollIntoView({ block: "center" });
  if (rect) {
    for (const svg of one.querySelectorAll("svg")) svg.querySelectorAll(".change")[i].classList.add("current");
    const [x, y, width, height] = ["x", "y", "width", "height"].map(name => +rect.getAttribute(name));
    const [across, down] = rect.ownerSVGElement.getAttribute("viewBox").split(" ").slice(2);
    const pane = one.querySelector(".pane").clientWidth;
    view(one, Math.min(8 * across / pane, across / width / 3, down / height / 3), (x + width / 2) / across,
         (y + height / 2) / down);
    const slider = one.querySelector("input[type=range]");  // so that both sides of the change are seen
    slider.value = 100 * ((x + width / 2) / across * one.zoom + one.shift[0] / pane);
    slider.dispatchEvent(new Event("input"));
  }
  by_id("place").textContent = `change ${place + 1} of ${changes.length}`;
}
const actions = { n: () => jump(1), p: () => jump(-1), "+": () => change(1.5), "=": () => change(1.5),
  "-": () => change(1 / 1.5), 0: () => view(frame, 1) };
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("[type=search], textarea")) return;
  if (frame && actions[event.key]) actions[event.key]();
});
for (const [id, key] of [["next", "n"], ["previous", "p"], ["more", "+"], ["less", "-"], ["whole", "0"]]) {
  by_id(id).addEventListener("click", () => frame && actions[key]());
}
for (const one of frames) {
  for (const pane of [...one.querySelectorAll(".pane")].reverse()) {
    const svg = one.querySelector(".pictures > svg");
    pane.append(pane.matches(".expected") || !one.querySelector(".expected") ? svg : svg.cloneNode(true));
  }
  one.at = [1];
  const pictures = one.querySelector(".pictures");
  pictures.addEventListener("pointerenter", () => frame = one);
  pictures.addEventListener("dragstart", event => event.preventDefault());
  pictures.addEventListener("pointermove", event => {
    if (event.buttons == 1 && one.zoom > 1) change(1, -event.movementX, -event.movementY);
  });
  pictures.addEventListener("wheel", event => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    const factor = event.deltaY < 0 ? 1.25 : .8;  // what is below the pointer stays there
    const { x, y, width, height } = event.target.closest(".pane").getBoundingClientRect();
    change(factor, (event.clientX - x - width / 2) * (1 - 1 / factor), (event.clientY - y - height / 2) * (1 - 1 / factor));
  }, { passive: false });
}
update();
