"use strict";
const byId = id => document.getElementById(id);
const video = byId("video");
const frames = Number(video.dataset.frames);
const [numerator, denominator] = video.dataset.rate.split("/").map(Number);
const rate = numerator / denominator;

/** The frame that is shown. Its time may be a rounding error before it. */
const frame = () => Math.min(frames - 1, Math.floor(video.currentTime * rate + 0.01));

function show(number) {
  video.pause();
  // The middle of the frame, so that no rounding leads to its neighbour.
  video.currentTime = (Math.max(0, Math.min(frames - 1, number)) + 0.5) / rate;
}

const steps = {
  "previous-frame": () => show(frame() - 1),
  "next-frame": () => show(frame() + 1),
};
for (const [id, step] of Object.entries(steps)) byId(id).addEventListener("click", step);

const keys = {",": "previous-frame", ".": "next-frame"};
document.addEventListener("keydown", event => {
  const id = keys[event.key];
  if (!id || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  steps[id]();
});

for (const name of ["loadedmetadata", "timeupdate", "seeked"]) {
  video.addEventListener(name, () => {
    byId("frame").textContent = `Frame ${(frame() + 1).toLocaleString("en")} of ${frames.toLocaleString("en")}`;
  });
}

const track = video.querySelector("track[kind=chapters]");
if (track) {
  track.addEventListener("load", () => {
    for (const chapter of track.track.cues) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = chapter.text;
      button.addEventListener("click", () => { video.currentTime = chapter.startTime + 0.5 / rate; });
      byId("chapters").append(button);
    }
    byId("chapters").hidden = false;
  });
  track.track.mode = "hidden";
}

function sayThatItCannotPlay() {
  byId("problem").textContent = "This browser cannot play the video.";
}
video.addEventListener("error", sayThatItCannotPlay);
// It may have failed before this script was read.
if (video.error) sayThatItCannotPlay();
document.body.style.setProperty("--shape", video.width / video.height);
byId("steps").hidden = false;
