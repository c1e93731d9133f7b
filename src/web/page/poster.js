// Shows a picture of the first scene until the program has drawn it, unless another scene is asked for, or
// another shape: a frame in another page has its own. It runs before the page is read to its end, which
// takes a while.
const isOther = location.hash.length > 1 || new URLSearchParams(location.search).get("embed") === "1" ||
  document.getElementById("opened-scene").textContent !== "null";
if (!isOther) document.documentElement.className = "poster";
