// A page without a browser: as much of the document as the page's modules use.
// Import it before the modules under test.

/** A canvas context that lists its calls: [name, ...arguments]. */
class FakeContext {
  constructor() {
    this.calls = [];
    const remember = (name) => (...values) => this.calls.push([name, ...values]);
    return new Proxy(this, {get: (context, name) => context[name] ?? remember(name)});
  }
}

export class FakeElement extends EventTarget {
  constructor(tag) {
    super();
    Object.assign(this, {tag, children: [], attributes: {}, dataset: {}, text: ''});
    Object.assign(this, {clientWidth: 200, clientHeight: 100, parent: null, value: ''});
    this.style = {setProperty() {}};
    this.classes = new Set();
    this.classList = {
      toggle: (name, isOn) => isOn ? this.classes.add(name) : this.classes.delete(name)
    };
  }

  get textContent() {
    return this.text + this.children.map((child) => child.textContent ?? child).join('');
  }

  set textContent(text) {
    this.text = text;
    this.children = [];
  }

  get checked() {
    return 'checked' in this.attributes;
  }

  set checked(isOn) {
    delete this.attributes.checked;
    if (isOn) this.attributes.checked = '';
  }

  appendChild(child) {
    this.append(child);
    return child;
  }

  append(...children) {
    for (const child of children.filter((one) => one instanceof FakeElement)) child.parent = this;
    this.children.push(...children);
  }

  replaceChildren(...children) {
    this.textContent = '';
    this.append(...children);
  }

  setAttribute(name, value) {
    this.attributes[name] = String(value);
  }

  getContext() {
    this.context ??= new FakeContext();
    return this.context;
  }

  /** @return whether it is of one of the listed tags; of selectors, only tags and [type=...]. */
  matches(selectors) {
    return selectors.split(', ').some((selector) => {
      const [tag, ...conditions] = selector.split(/(?=:not)|(?<!\()(?=\[)/);
      return tag === this.tag && conditions.every((condition) => this.meets(condition));
    });
  }

  meets(condition) {
    const type = condition.match(/type=(\w+)/)[1];
    return (this.attributes.type === type) !== condition.startsWith(':not');
  }

  closest(tag) {
    return this.tag === tag ? this : this.parent?.closest(tag) ?? null;
  }

  focus() {
    document.activeElement = this;
  }

  querySelectorAll(tag) {
    return this.all(tag);
  }

  /** @return all elements of a tag below this one. */
  all(tag) {
    const elements = this.children.filter((child) => child instanceof FakeElement);
    return elements.flatMap((child) => [...(child.tag === tag ? [child] : []), ...child.all(tag)]);
  }
}

const named = new Map();

class FakeDocument extends EventTarget {
  documentElement = new FakeElement('html');

  getElementById(id) {
    if (!named.has(id)) named.set(id, new FakeElement('div'));
    return named.get(id);
  }

  createElement(tag) {
    return new FakeElement(tag);
  }

  createElementNS(_, tag) {
    return new FakeElement(tag);
  }
}

Object.assign(globalThis, {
  document: new FakeDocument(),
  window: {matchMedia: () => ({matches: false, addEventListener() {}}), devicePixelRatio: 1},
  Element: FakeElement,
  getComputedStyle: () => ({getPropertyValue: (name) => `colour of ${name}`}),
  ResizeObserver: class {observe() {}},
});

/** @return the element of an id, as on a page that was just opened. */
export function freshElement(id) {
  named.delete(id);
  return document.getElementById(id);
}
