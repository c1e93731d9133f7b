const filter = document.getElementById("filter");
const refused = document.getElementById("refused");
const difference = document.getElementById("difference");
const sections = document.querySelectorAll("section, li");
function update() {
  for (const section of sections) {
    const name = section.querySelector("h2, b").textContent.toLowerCase();
    const matches = name.includes(filter.value.toLowerCase());
    section.hidden = !matches || (refused.checked && !section.classList.contains("refused"));
  }
  document.body.classList.toggle("show-difference", difference.checked);
}
for (const control of [filter, refused, difference]) control.addEventListener("input", update);
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
  const zoom = devicePixelRatio * visualViewport.scale;
  for (const image of document.images) {
    image.classList.toggle("enlarged", image.clientWidth * zoom > image.naturalWidth);
  }
}
for (const target of [window, visualViewport]) target.addEventListener("resize", mark_enlarged);
window.addEventListener("load", mark_enlarged);
const sizes = new ResizeObserver(mark_enlarged);
for (const image of document.images) sizes.observe(image);
update();
