// Shows a picture of the first scene until the program has drawn it, unless another scene is asked for.
// It runs before the page is read to its end, which takes a while.
if (location.hash.length < 2 && document.getElementById("opened-scene").textContent === "null") {
  document.documentElement.className = "poster";
}
