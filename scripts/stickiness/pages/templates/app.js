"use strict";
// Sends what the form asks, one question at a time, and shows the page of the answer.
const form = document.querySelector("form");
const word = document.getElementById("word");
const shown = document.getElementById("answer");
const line = document.getElementById("command");
const kept = []; // materials to compare with
let file = "";
let isAsking = false;
let isChanged = false;

const PREFIXES = { n: -9, "µ": -6, u: -6, m: -3, "": 0, k: 3, M: 6, G: 9 };

// Ten to a power with a prefix and a unit, and back; NaN of a text that is no such value.
function tellPower(power, unit) {
  if (!unit) return String(Number((10 ** power).toPrecision(3)));
  const step = Math.min(3, Math.max(-3, Math.floor((power + 1e-9) / 3)));
  const value = Number((10 ** (power - 3 * step)).toPrecision(3));
  return `${value} ${["n", "u", "m", "", "k", "M", "G"][step + 3]}${unit}`;
}
function readPower(text, unit) {
  const parts = text.trim().match(/^([\d.]+(?:e[-+]?\d+)?)\s*(.*)$/i);
  if (!parts || !parts[2].endsWith(unit)) return NaN;
  return Math.log10(parts[1]) + PREFIXES[parts[2].slice(0, parts[2].length - unit.length)];
}

function textsOf(group) {
  const inputs = form.querySelectorAll(`[data-group="${group}"]`);
  return Object.fromEntries([...inputs].map((input) => [input.name, input.value]));
}
function material() {
  return { common: form.common.value, ...textsOf("material") };
}
function question() {
  const kind = form.kind.value;
  return JSON.stringify({ kind, file, surface: textsOf(kind), material: material(), kept });
}
async function post(what, body) {
  let answer;
  try {
    answer = await fetch(what, { method: "POST", body });
  } catch {
    throw new Error("The app has ended. Start it again, and open the address that it prints.");
  }
  if (!answer.ok) throw new Error(`The app could not do this (${answer.status}).`);
  return answer;
}
// What is wrong, in place of an answer, and the fields that it names.
function fail(text) {
  word.textContent = text;
  line.textContent = "";
  shown.innerHTML = '<ul class="answers doubts" role="alert"><li></li></ul>';
  shown.querySelector("li").textContent = text;
  mark(text);
}
function mark(text) {
  for (const field of form.querySelectorAll("[data-group]"))
    field.setAttribute("aria-invalid", text.includes(field.parentNode.firstChild.textContent));
}

// While a question is answered, only the last of those that follow waits.
async function ask() {
  isChanged = true;
  if (isAsking) return;
  isAsking = true;
  const start = Date.now();
  const clock = setInterval(() => {
    word.textContent = `Working … ${Math.round((Date.now() - start) / 1000)} s`;
  }, 1000);
  shown.setAttribute("aria-busy", "true");
  try {
    while (isChanged) {
      isChanged = false;
      const answer = await (await post("answer", question())).json();
      if (!isChanged) show(answer);
    }
  } catch (error) {
    fail(error.message);
  }
  clearInterval(clock);
  word.classList.remove("stale");
  shown.removeAttribute("aria-busy");
  isAsking = false;
}
function show(answer) {
  if (answer.error) return fail(answer.error);
  mark("");
  const main = new DOMParser().parseFromString(answer.page, "text/html").querySelector("main");
  // Files of data are those of "Save page".
  for (const link of main.querySelectorAll("a.data")) link.replaceWith(...link.childNodes);
  const open = [...shown.querySelectorAll("details[open] > summary")].map((e) => e.textContent);
  for (const summary of main.querySelectorAll("details > summary"))
    if (open.includes(summary.textContent)) summary.parentNode.open = true;
  shown.replaceChildren(main);
  const sentence = main.querySelector(".answers:not(.doubts) li")?.firstChild.textContent;
  word.textContent = sentence ? sentence.split(". ")[0] : "Not judged";
  line.textContent = answer.command;
}

async function send(chosen) {
  const chooser = form.querySelector("[type=file]");
  const { most, keys } = chooser.dataset;
  chooser.value = "";
  document.getElementById("name").textContent = chosen.name;
  form.kind.value = "measured";
  showKind();
  for (const key of keys.split(" ")) form.querySelector(`[data-group=measured][name=${key}]`).value = "";
  if (chosen.size > most)
    return fail(`${chosen.name}: larger than ${most / 1e6} MB; take a part of the heights`);
  try {
    const kept = await post(`file?name=${encodeURIComponent(chosen.name)}`, chosen);
    ({ file } = await kept.json());
    ask();
  } catch (error) {
    fail(error.message);
  }
}
async function save(what) {
  const archive = await (await post(what, question())).blob();
  if (archive.type.includes("json")) return fail(JSON.parse(await archive.text()).error);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(archive);
  link.download = `stickiness-${what}.zip`;
  link.click();
}
const actions = {
  keep: () => {
    const isNew = !kept.some((each) => JSON.stringify(each) === JSON.stringify(material()));
    if (isNew) kept.unshift(material());
    ask();
  },
  forget: () => { kept.length = 0; ask(); },
  page: () => save("page").catch((error) => fail(error.message)),
  configuration: () => save("configuration").catch((error) => fail(error.message)),
  copy: (button) => {
    const label = button.textContent;
    const done = line.textContent ? "Copied" : "The command takes measured heights only";
    navigator.clipboard.writeText(line.textContent).then(() => { button.textContent = done; });
    setTimeout(() => { button.textContent = label; }, 2000);
  },
};

function showKind() {
  for (const part of form.querySelectorAll("[data-kind]"))
    part.hidden = part.dataset.kind !== form.kind.value;
}
// A slider and the text above it say the same; a value that may be left out is not given at its start.
for (const slider of form.querySelectorAll(".slider")) {
  const input = slider.previousElementSibling.querySelector("input");
  input.follow = () => {
    const power = readPower(input.value, input.dataset.unit);
    slider.value = Number.isNaN(power) ? slider.min : power;
    slider.setAttribute("aria-valuetext", input.value || "not given");
  };
  slider.addEventListener("input", () => {
    const isNone = "none" in slider.dataset && slider.value === slider.min;
    input.value = isNone ? "" : tellPower(Number(slider.value), input.dataset.unit);
    slider.setAttribute("aria-valuetext", input.value || "not given");
    word.classList.add("stale"); // until it is let go
  });
  input.follow();
}
form.addEventListener("change", (event) => {
  const { target } = event;
  if (target.type === "file") return target.files[0] && send(target.files[0]);
  if (target === form.kind) showKind();
  if (target === form.common)
    for (const [key, text] of Object.entries(target.selectedOptions[0].dataset)) {
      form[key].value = text;
      form[key].follow?.();
    }
  target.follow?.();
  ask();
});
form.addEventListener("submit", (event) => event.preventDefault());
form.addEventListener("click", (event) => actions[event.target.dataset.do]?.(event.target));
for (const kind of ["dragover", "dragleave", "drop"])
  document.addEventListener(kind, (event) => {
    event.preventDefault();
    document.body.classList.toggle("drop", kind === "dragover");
    if (kind === "drop" && event.dataTransfer.files[0]) send(event.dataTransfer.files[0]);
  });
showKind();
ask();
