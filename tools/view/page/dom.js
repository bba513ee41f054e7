// Helpers for elements. Contents of messages and takes are only inserted as text.

/** @return the element of index.html with an id. */
export function byId(id) {
  return document.getElementById(id);
}

function fill(element, {text, ...attributes}, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== false) element.setAttribute(name, value);
  }
  if (text !== undefined) element.textContent = text;
  element.append(...children);
  return element;
}

/** Makes an element; `text` is its text, other entries are attributes. */
export function make(tag, entries = {}, ...children) {
  return fill(document.createElement(tag), entries, children);
}

/** Makes an element of a drawing, likewise. */
export function makeSvg(tag, entries = {}, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), entries, children);
}

/** Sets a text only when it changes, to keep selections and not disturb screen readers. */
export function setText(element, text) {
  const value = String(text);
  if (element.textContent !== value) element.textContent = value;
}

/** Fits a canvas to its size on the screen. @return its context, scaled to CSS pixels. */
export function fitCanvas(canvas) {
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const width = Math.round(canvas.clientWidth * ratio);
  const height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  // For small, changing pictures the processor is faster than a transfer to the graphics card.
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  return context;
}
