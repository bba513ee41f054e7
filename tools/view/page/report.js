// A report: sections from JSON in a page that was saved as one file. Each type has a component.

import {byId, make, setText} from './dom.js';
import {drawLines} from './picture_lines.js';
import {placeOf, svgPlot} from './svg_plot.js';
import {fixed} from './text.js';
import {figureColor, startTheme} from './theme.js';
import {runsOf} from './timeline.js';
import {BRIDGED, STATES} from './wire.js';

const PICTURE_PX = 800;  // width of a drawn picture, for screens of high resolution and paper
const PICTURE_CSS_PX = 400;  // for which the lines have their width

function swatch(figure) {
  return make('span', {class: `swatch ${figureColor(figure)}`, 'aria-hidden': 'true'});
}

/** A cell's text: {text, figure?, tone?}, a text, or a number; null is unknown. */
function cell(value, {decimals, signed}) {
  if (typeof value === 'string') return make('td', {text: value});
  if (value?.text === undefined) {
    const text = fixed(value, decimals ?? 0);
    return make('td', {class: 'number', text: signed && value > 0 ? `+${text}` : text});
  }
  const mark = value.figure === undefined ? [] : [swatch(value.figure)];
  return make('td', {'data-tone': value.tone}, ...mark, value.text);
}

function bar(value, most) {
  const filled = make('i');
  filled.style.width = `${100 * value / most}%`;
  return make('td', {class: 'bar'}, filled);
}

function drawTable({columns, rows}) {
  const heads = columns.flatMap(
      ({name, decimals, bars}) =>
          [make('th', {scope: 'col', text: name, class: decimals === undefined ? '' : 'number'}),
           ...bars ? [make('th')] : []]);
  const tops = columns.map((_, i) => Math.max(1e-9, ...rows.map((row) => Number(row[i]) || 0)));
  const body = rows.map(
      (row) => make(
          'tr', {},
          ...row.flatMap(
              (value, i) =>
                  [cell(value, columns[i]), ...columns[i].bars ? [bar(value, tops[i])] : []])));
  return make(
      'table', {}, make('thead', {}, make('tr', {}, ...heads)), make('tbody', {}, ...body));
}

/** Draws as wide as there is room, again when that changes. */
function fitted(plot) {
  const holder = make('div', {class: plot.equal ? 'plan' : ''});
  const room = () => Math.floor(holder.clientWidth);
  let drawn = 0;
  const draw = () => {
    if (room() === 0 || room() === drawn) return;
    drawn = room();
    const isFree = plot.equal && !plot.y.range;
    const height = isFree ? Math.round(0.85 * drawn) : plot.height;
    holder.replaceChildren(svgPlot({...plot, height}, drawn));
  };
  new ResizeObserver(draw).observe(holder);
  return holder;
}

function drawFigure({title, caption, plots, columns}) {
  const drawn = make('div', {class: columns > 1 ? 'columns' : ''}, ...plots.map(fitted));
  const text = title ? [make('b', {text: title}), ' '] : [];
  return make('figure', {}, drawn, make('figcaption', {}, ...text, caption ?? ''));
}

function drawTiles({tiles}) {
  return make('dl', {class: 'tiles'}, ...tiles.map(({name, value, decimals, unit, under}) => make(
      'div', {}, make('dt', {text: name}),
      make('dd', {}, make('span', {class: 'big', text: fixed(value, decimals)}), ` ${unit}`),
      make('dd', {class: 'under', text: under}))));
}

/** Bands of states over the frames: {name, figure, x, states} each, x as of a plot. */
function drawStates({people}) {
  const ends = people.filter(({states}) => states.length > 0)
                   .map(({x, states}) => [placeOf(x, 0), placeOf(x, states.length - 1)]);
  const first = Math.min(...ends.map(([from]) => from));
  const end = Math.max(...ends.map(([, to]) => to + 1));
  const share = (frames) => `${100 * frames / (end - first)}%`;
  const bands = people.flatMap((person) => {
    const runs = runsOf(person.states).map((run) => {
      const [from, to] = [run.from, run.to - 1].map((i) => placeOf(person.x, i));
      const part = make('i', {
        class: `state-key ${STATES[run.value]}`,
        title: `${STATES[run.value]}: frames ${from} to ${to}`
      });
      part.style.left = share(from - first);
      part.style.width = share(to + 1 - from);
      return part;
    });
    const name = person.name ? [make('p', {class: 'note'}, swatch(person.figure), person.name)] : [];
    return [...name, make('div', {class: 'band'}, ...runs)];
  });
  const all = people.flatMap((person) => person.states);
  const counts = STATES.map((state, i) => ({state, count: all.filter((value) => value === i).length}));
  const key = counts.filter(({count}, i) => i !== BRIDGED || count > 0).map(({state, count}) => make(
      'span', {class: 'state-entry'}, make('span', {class: `state-key ${state}`}),
      `${state} ${count}`));
  return make('section', {}, ...bands, make('p', {class: 'note'}, ...key));
}

async function drawPicture(canvas, picture) {
  const image = new Image();
  image.src = picture.jpeg;
  await image.decode();
  const [width, scale] = [PICTURE_CSS_PX, PICTURE_PX / PICTURE_CSS_PX];
  const height = width * picture.height_px / picture.width_px;
  const context = canvas.getContext('2d');
  context.scale(scale, scale);
  context.drawImage(image, 0, 0, width, height);
  const sizes = {widthPx: picture.width_px, heightPx: picture.height_px};
  drawLines(context, {...picture, ...sizes}, width, height);
}

function pictureOf(picture) {
  const height = Math.round(PICTURE_PX * picture.height_px / picture.width_px);
  const canvas = make('canvas', {width: PICTURE_PX, height, role: 'img', 'aria-label': picture.name});
  drawPicture(canvas, picture);
  return make('div', {}, canvas, make('p', {class: 'note', text: picture.name}));
}

function drawPictures({moments, keys}) {
  const legend = keys.map(({name, text}) => make('span', {}, make('i', {class: `${name}-key`}), text));
  const shown = moments.flatMap(
      ({name, pictures}) =>
          [make('h3', {text: name}), make('div', {class: 'views'}, ...pictures.map(pictureOf))]);
  return make('section', {}, make('p', {class: 'picture-legend'}, ...legend), ...shown);
}

const COMPONENTS = {
  heading: ({text}) => make('h2', {text}),
  text: ({text, tone}) => make('p', {text, 'data-tone': tone}),
  tiles: drawTiles,
  table: drawTable,
  figure: drawFigure,
  states: drawStates,
  pictures: drawPictures,
  columns: ({sections}) => make('div', {class: 'columns'}, ...sections.map(
      (inner) => make('div', {}, ...inner.map(draw)))),
  details: ({name, figure, sections}) => make(
      'details', {}, make('summary', {}, swatch(figure), name), ...sections.map(draw)),
};

/** @return the element of a section. */
export function draw(section) {
  return COMPONENTS[section.type](section);
}

/** Shows the report of the page. */
export function start() {
  const {title, under, sections} = JSON.parse(byId('data').textContent);
  document.title = title;
  setText(byId('title'), title);
  startTheme();
  byId('report').append(make('p', {class: 'note', text: under}), ...sections.map(draw));
}

if (byId('data')?.textContent) start();
