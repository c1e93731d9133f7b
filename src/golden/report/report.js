const filter = document.getElementById("filter");
const refused = document.getElementById("refused");
const difference = document.getElementById("difference");
const sections = document.querySelectorAll("section");
function update() {
  for (const section of sections) {
    const name = section.querySelector("h2").textContent.toLowerCase();
    const matches = name.includes(filter.value.toLowerCase());
    section.hidden = !matches || (refused.checked && !section.classList.contains("refused"));
  }
  document.body.classList.toggle("show-difference", difference.checked);
}
for (const control of [filter, refused, difference]) control.addEventListener("input", update);
for (const slider of document.querySelectorAll("input[type=range]")) {
  slider.addEventListener("input", () =>
    slider.previousElementSibling.style.setProperty("--split", slider.value + "%"));
}
update();
