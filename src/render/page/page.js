"use strict";
const byId = id => document.getElementById(id);
const facts = JSON.parse(byId("facts").textContent);
const video = byId("video");
const slider = byId("time-slider");
const rate = facts.rate[0] / facts.rate[1];
const lastFrame = facts.frames - 1;

/** Whole numbers, given by what each adds to the one before; "0~7" adds 0 seven times. */
function numbers(text) {
  const values = [];
  let value = 0n;
  for (const word of text.split(" ").filter(word => word)) {
    const [difference, times = "1"] = word.split("~");
    const step = BigInt(difference);
    for (let left = Number(times); left > 0; --left) values.push(value += step);
  }
  return values;
}

// Exact at any size: the count of every frame, and the times of the collisions that are listed,
// in units of 10^-scale.
const counts = numbers(facts.counts);
const from = BigInt(facts.from);
const lists = facts.lists.map(list => {
  const times = numbers(list.times);
  const first = BigInt(list.first);
  return {first, last: first + BigInt(times.length) - 1n, times};
});

/** The first number from 0 to `end` for which this holds, as it does for all behind it; or `end`. */
function firstWhere(end, holds) {
  let low = 0;
  while (low < end) {
    const middle = (low + end) >> 1;
    if (holds(middle)) end = middle; else low = middle + 1;
  }
  return low;
}

/** Simulation time that a frame shows, since that of the first one. */
function offsetOf(frame) {
  const now = frame / rate;
  const next = firstWhere(facts.stretches.length, i => facts.stretches[i][0] > now);
  const [start, offset, speed] = facts.stretches[Math.max(0, next - 1)];
  return offset + speed * (now - start);
}

/** The frame nearest to an instant, on the way forth; of equal ones the first. */
function frameNear(offset) {
  const after = firstWhere(facts.forth - 1, frame => offsetOf(frame) >= offset);
  const isNearer = after > 0 && offset - offsetOf(after - 1) < offsetOf(after) - offset;
  return isNearer ? frameNear(offsetOf(after - 1)) : after;
}

/** The first frame with so many collisions. */
const frameWith = count => firstWhere(facts.forth - 1, frame => counts[frame] >= count);

const listOf = index => lists.find(list => list.first <= index && index <= list.last);
const timeOf = index => {
  const list = listOf(index);
  return list.times[Number(index - list.first)];
};

/** A time in units of 10^-scale as a decimal. */
function decimal(time, decimals) {
  const unit = 10n ** BigInt(facts.scale - decimals);
  const size = ((time < 0n ? -time : time) + unit / 2n) / unit;
  const digits = size.toString().padStart(decimals + 1, "0");
  const point = digits.length - decimals;
  return (time < 0n && size > 0n ? "\u2212" : "") + digits.slice(0, point) +
    (decimals > 0 ? "." + digits.slice(point) : "");
}

function frameTime(frame) {
  const steps = BigInt(Math.round(offsetOf(frame) * 10 ** facts.decimals));
  return decimal(from + steps * 10n ** BigInt(facts.scale - facts.decimals), facts.decimals);
}

// What is looked at: a frame, or a collision and the first frame that shows it.
let frame = 0;
let collision = null;
/** From the video's start to its end or to the next step; its events may come later than that. */
let isPlaying = false;

const count = () => collision ?? counts[frame];
const grouped = number => number.toLocaleString("en");
/** Where the blocks come to rest after infinitely many collisions, the last count stands for these. */
const infinite = facts.infinite === null ? null : BigInt(facts.infinite);
const countText = number => number === infinite ? "\u221E" : grouped(number);
const collisionsText = number => number === infinite ? "infinitely many collisions"
  : `${grouped(number)} ${number === 1n ? "collision" : "collisions"}`;

function update() {
  const time = collision === null ? frameTime(frame) : decimal(timeOf(collision), facts.scale);
  byId("count").textContent = countText(count());
  byId("time").textContent = time;
  byId("frame").textContent = `${grouped(frame + 1)} of ${grouped(facts.frames)}`;
  const picture = byId("picture");
  picture.hidden = counts[frame] === count();
  picture.textContent = `(picture: after ${collisionsText(counts[frame])})`;
  slider.value = collision === null ? offsetOf(frame)
    : Number(timeOf(collision) - from) / 10 ** facts.scale;
  slider.setAttribute("aria-valuetext", `time ${time}, ${collisionsText(count())}`);
}

function show(newFrame, newCollision = null) {
  video.pause();
  isPlaying = false;
  frame = Math.max(0, Math.min(lastFrame, newFrame));
  collision = newCollision;
  // The middle of the frame, so that no rounding leads to its neighbour.
  video.currentTime = (frame + 0.5) / rate;
  update();
}

const showCollision = index => show(frameWith(index), index);

/** Where no times are listed, the steps lead from frame to frame that shows another count. */
function nextCollision() {
  const target = count() + 1n;
  if (listOf(target)) return showCollision(target);
  const other = frameWith(target);
  if (counts[other] < target) return;
  const list = lists.find(list => list.first > target && list.first <= counts[other]);
  if (list) showCollision(list.first); else show(other);
}

function previousCollision() {
  const isPast = collision === null && listOf(count());
  const target = isPast ? count() : count() - 1n;
  if (listOf(target)) return showCollision(target);
  if (target < counts[0]) return;
  const other = counts[Math.max(0, frameWith(target + 1n) - 1)];
  const list = lists.findLast(list => list.last < target && list.last >= other);
  if (list) showCollision(list.last); else show(frameWith(other));
}

function playOrPause() {
  // The picture may be one further than the read-outs.
  if (!video.paused) return show(frame);
  // At its end a video begins again.
  if (frame === lastFrame) video.currentTime = 0;
  // A pause may come before the first picture, which is no fault.
  video.play().catch(() => {});
}

/** While the video plays, the read-outs say what it shows. */
function follow(time_s) {
  if (isPlaying && !video.paused) {
    frame = Math.max(0, Math.min(lastFrame, Math.floor(time_s * rate + 0.01)));
    collision = null;
    update();
  }
}
if (video.requestVideoFrameCallback) {
  const onPicture = (_, about) => {
    follow(about.mediaTime);
    video.requestVideoFrameCallback(onPicture);
  };
  video.requestVideoFrameCallback(onPicture);
} else {
  video.addEventListener("timeupdate", () => follow(video.currentTime));
}

function onPlaying() {
  isPlaying ||= !video.paused;
  byId("play").textContent = video.paused ? "Play" : "Pause";
  // Nobody can listen to sixty counts a second.
  for (const id of ["count", "time"]) {
    byId(id).setAttribute("aria-live", video.paused ? "polite" : "off");
  }
}
for (const name of ["play", "pause"]) video.addEventListener(name, onPlaying);
video.addEventListener("volumechange", () => {
  byId("sound").textContent = video.muted ? "Sound on" : "Sound off";
});
video.addEventListener("ended", () => {
  if (!isPlaying) return;
  isPlaying = false;
  frame = lastFrame;
  collision = null;
  update();
});
function sayThatItCannotPlay() {
  byId("problem").textContent = "This browser cannot play the video.";
}
video.addEventListener("error", sayThatItCannotPlay);
// It may have failed before this script was read.
if (video.error) sayThatItCannotPlay();

const actions = {
  start: () => show(0),
  "previous-collision": previousCollision,
  "previous-frame": () => show(frame - 1),
  play: playOrPause,
  "next-frame": () => show(frame + 1),
  "next-collision": nextCollision,
  end: () => show(facts.forth - 1),
  sound: () => { video.muted = !video.muted; },
};
for (const [id, action] of Object.entries(actions)) byId(id).addEventListener("click", action);
video.addEventListener("click", playOrPause);
slider.addEventListener("input", () => show(frameNear(Number(slider.value))));

const keys = {
  " ": "play", ArrowLeft: "previous-frame", ArrowRight: "next-frame", Home: "start", End: "end",
  ",": "previous-collision", ".": "next-collision", m: "sound",
};
document.addEventListener("keydown", event => {
  const id = keys[event.key];
  const hasOwnUse = event.key === " " && event.target.closest("button");
  if (!id || hasOwnUse || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  actions[id]();
});

document.body.style.setProperty("--shape", video.width / video.height);
slider.max = offsetOf(facts.forth - 1);
video.controls = false;
video.loop = facts.loop;
byId("sound").hidden = !facts.sound;
byId("controls").hidden = false;
onPlaying();
show(0);
