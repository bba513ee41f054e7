// Light or dark: the system's setting, unless chosen here. view.css defines the colours.

import {byId, setText} from './dom.js';

const KEY = 'mocapd-view-theme';
const dark = window.matchMedia('(prefers-color-scheme: dark)');
const listeners = [];
let cache = new Map();

function stored() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function apply(theme) {
  document.documentElement.dataset.theme = theme;
  setText(byId('theme'), theme === 'dark' ? 'Light' : 'Dark');
  byId('theme').setAttribute('aria-label', `Use ${theme === 'dark' ? 'light' : 'dark'} colours`);
  cache = new Map();
  for (const listener of listeners) listener();
}

/** Follows the system and the button. */
export function startTheme() {
  apply(stored() ?? (dark.matches ? 'dark' : 'light'));
  dark.addEventListener('change', () => stored() ?? apply(dark.matches ? 'dark' : 'light'));
  byId('theme').addEventListener('click', toggleTheme);
}

export function toggleTheme() {
  const theme = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Without storage, the choice lasts until the page is closed.
  }
  apply(theme);
}

/** Registers a callback for changes of colours. */
export function onTheme(listener) {
  listeners.push(listener);
}

/** @return a colour of view.css by its name without dashes: color('accent') → "#1f5fbf". */
export function color(name) {
  if (!cache.has(name)) {
    const style = getComputedStyle(document.documentElement);
    cache.set(name, style.getPropertyValue(`--${name}`).trim() || '#888888');
  }
  return cache.get(name);
}

/** @return the same as red, green, blue, from 0 to 1. */
export function rgb(name) {
  const number = parseInt(color(name).slice(1), 16);
  return [number >> 16 & 255, number >> 8 & 255, number & 255].map((value) => value / 255);
}

/** @return the colour of a person or result by index. */
export function figureColor(index) {
  return `figure-${index % 8}`;
}
