import assert from 'node:assert/strict';
import test from 'node:test';

import {freshElement} from './fake_page.mjs';

const {draw, start} = await import('../../../../tools/view/page/report.js');

const rowsOf = (table) =>
    table.all('tr').map((row) => row.children.map((child) => child.textContent));

test('a table has names, numbers with their decimals, and dashes for what is unknown', () => {
  const columns = [{name: 'camera'}, {name: 'mm', decimals: 1}, {name: 'error', decimals: 1, signed: true}];
  const table = draw({type: 'table', columns, rows: [['cam1', 2.25, 3], ['cam2', null, -1]]});
  assert.deepEqual(
      rowsOf(table), [['camera', 'mm', 'error'], ['cam1', '2.3', '+3.0'], ['cam2', '–', '-1.0']]);
});

test('bars are as long as their number of the largest', () => {
  const columns = [{name: 'point'}, {name: 'mm', decimals: 0, bars: true}];
  const table = draw({type: 'table', columns, rows: [['head', 5], ['foot', 20]]});
  assert.deepEqual(table.all('i').map(({style}) => style.width), ['25%', '100%']);
  assert.equal(table.all('th').length, 3, 'the bars have a column of their own');
});

test('people in a table have their colour, and findings their tone', () => {
  const rows = [[{text: 'person-2', figure: 1}, {text: 'error', tone: 'bad'}]];
  const table = draw({type: 'table', columns: [{name: 'tracked'}, {name: 'kind'}], rows});
  assert.equal(table.all('span')[0].attributes.class, 'swatch figure-1');
  assert.equal(table.all('td')[1].attributes['data-tone'], 'bad');
});

test('tiles tell name, value and unit', () => {
  const tiles = [{name: 'Error', value: 12.34, decimals: 1, unit: 'mm', under: 'mean'}];
  assert.equal(draw({type: 'tiles', tiles}).textContent, 'Error12.3 mmmean');
});

test('bands of states lie where their frames do', () => {
  const people = [
    {name: 'a', figure: 0, x: {first: 10}, states: [1, 2, 2, 2]},
    {name: 'b', figure: 1, x: {values: [12, 18, 19]}, states: [3, 2, 2]}
  ];
  const section = draw({type: 'states', people});
  const places = section.all('i').map(({style: {left, width}}) => [left, width]);
  assert.deepEqual(places, [['0%', '10%'], ['10%', '30%'], ['20%', '10%'], ['80%', '20%']]);
  assert.equal(section.all('i')[1].attributes.title, 'tracking: frames 11 to 13');
  assert.match(section.textContent, /acquiring 1tracking 5lost 1/);
});

test('a figure has a caption and a place for each plot', () => {
  const plots = [1, 2].map(() => ({x: {label: 'x'}, y: {label: 'y'}, series: []}));
  const figure = draw({type: 'figure', title: 'Error', caption: 'by frame', plots});
  assert.equal(figure.all('figcaption')[0].textContent, 'Error by frame');
  assert.equal(figure.all('div').length, 3);
});

test('sections lie in others: side by side, or folded', () => {
  const inner = {type: 'text', text: 'inner'};
  assert.equal(draw({type: 'columns', sections: [[inner], [inner]]}).all('p').length, 2);
  const details = draw({type: 'details', name: 'person-1', figure: 0, sections: [inner]});
  assert.equal(details.textContent, 'person-1inner');
});

test('the page shows what its data says, and foreign names are only text', () => {
  const title = '<script>alert(1)</script>';
  freshElement('data').textContent =
      JSON.stringify({title, under: 'by x', sections: [{type: 'heading', text: 'First'}]});
  const report = freshElement('report');
  start();
  assert.equal(document.title, title);
  assert.equal(document.getElementById('title').text, title);
  assert.deepEqual(report.children.map((child) => child.textContent), ['by x', 'First']);
});
