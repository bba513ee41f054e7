// Actions on the page. They need the token of the address that `mocap view` printed.

import {byId, make, setText} from './dom.js';
import {PersonChoice} from './person_choice.js';

const KEY = 'mocapd-view-token';
const NAME = /^[A-Za-z0-9._-]{1,64}$/;
const NO_TOKEN = 'This page is read-only. To record and control, open the address that ' +
    'mocap view printed, with its #token=…';

/** Removes the token from the address bar, where others could read it. */
export function takeToken() {
  const found = new URLSearchParams(location.hash.slice(1)).get('token');
  if (found) {
    sessionStorage.setItem(KEY, found);
    history.replaceState(null, '', location.pathname + location.search);
  }
  return sessionStorage.getItem(KEY);
}

/** @return the names in a `subject list`: lines with a stature. */
export function subjectNames(text) {
  return text.split('\n').map((line) => /^(\S+)\s+stature\b/.exec(line)?.[1]).filter(Boolean);
}

export class Actions {
  constructor() {
    this.token = takeToken();
    this.isAllowed = false;
    this.why = '';  // the server's reason against it
    this.isBusy = false;
    this.choice = new PersonChoice();
    this.bind();
    this.check();
    window.addEventListener('hashchange', () => {
      this.token = takeToken();
      this.check();
    });
  }

  /** Sets the server's reason why actions are unavailable; '' if there is none. */
  setNotice(why) {
    this.why = why;
    this.show();
  }

  /** Shows the appropriate button: start or stop. */
  setRecording(state) {
    byId('record-form').dataset.state = state;
    byId('record-start').hidden = state === 'running';
    byId('record-name').hidden = state === 'running';
    byId('record-stop').hidden = state !== 'running';
  }

  /** Offers a choice of the person whose sizes are saved, if there are several. */
  setPeople(rows) {
    this.choice.take(rows);
    this.showChoice();
  }

  showChoice() {
    const list = byId('subject-person');
    list.hidden = !this.choice.isOffered;
    const options = this.choice.options();
    const said = JSON.stringify(options);
    if (said === this.saidOptions) return;
    this.saidOptions = said;
    list.replaceChildren(...options.map((option) => make('option', option)));
  }

  /** Checks whether the token is valid; call it after each connection. */
  async check() {
    this.isAllowed = false;
    if (this.token) {
      try {
        const answer = await fetch('/control', {headers: {Authorization: `Bearer ${this.token}`}});
        this.isAllowed = answer.status === 204;
      } catch {
        // Without a server there is nothing to do; the connection state shows it.
      }
    }
    this.show();
    if (this.isAllowed && this.why === '') this.list();
  }

  show() {
    const isOn = this.isAllowed && this.why === '';
    byId('action-forms').hidden = !isOn;
    byId('no-actions').hidden = isOn;
    const wrong = this.token && !this.isAllowed ?
        'The token of this page is no longer valid. ' + NO_TOKEN :
        NO_TOKEN;
    setText(byId('no-actions'), this.why !== '' ? this.why : wrong);
  }

  bind() {
    const onSubmit = (id, request) => byId(id).addEventListener('submit', (event) => {
      event.preventDefault();
      request();
    });
    const onClick = (id, request) => byId(id).addEventListener('click', request);
    onSubmit('record-form', () => this.withName('record start', byId('record-name')));
    onClick('record-stop', () => this.ask('record stop'));
    onSubmit('save-form', () => this.save());
    byId('subject-person').addEventListener('change', ({target}) => {
      this.choice.choose(target.value);
      this.showChoice();
    });
    onSubmit('load-form', () => this.withName('subject load', byId('subject-list')));
    onClick('subject-new', () => this.ask('subject new'));
    onClick('reload', () => this.ask('reload'));
    onClick('background-learn', () => this.learn());
    byId('subject-list').addEventListener('pointerdown', () => this.list());
  }

  async save() {
    if (this.choice.isGone) {
      byId('subject-person').focus();
      return this.answer('wrong', 'The chosen person has left. Choose whose sizes to save.');
    }
    const {value} = this.choice;
    await this.withName('subject save', byId('subject-name'), value === '' ? '' : ` ${value}`);
    return this.list();
  }

  withName(request, field, more = '') {
    const name = field.value.trim();
    if (NAME.test(name)) return this.ask(`${request} ${name}${more}`);
    field.focus();
    return this.answer('wrong', 'A name has letters, digits, ".", "_" and "-", at most 64.');
  }

  async learn() {
    const isSure = await this.confirm(
        'Learn the background?', 'Nobody may be in the cameras’ view. It takes some seconds.',
        'Learn');
    if (!isSure) return;
    const {outcome, text} = await this.ask('background learn');
    if (outcome !== 'failed' || !text.includes('--anyway')) return;
    if (await this.confirm('Learn it anyway?', text, 'Learn anyway'))
      this.ask('background learn anyway');
  }

  confirm(title, text, button) {
    const dialog = byId('confirm');
    setText(byId('confirm-title'), title);
    setText(byId('confirm-text'), text);
    setText(byId('confirm-yes'), button);
    dialog.returnValue = '';
    dialog.showModal();
    return new Promise((resolve) => {
      dialog.addEventListener('close', () => resolve(dialog.returnValue === 'yes'), {once: true});
    });
  }

  async list() {
    const {outcome, text} = await this.post('subject list');
    if (outcome !== 'done') return;
    const names = subjectNames(text);
    const chosen = byId('subject-list').value;
    byId('subject-list')
        .replaceChildren(...names.map(
            (name) => make('option', {text: name, value: name, selected: name === chosen})));
    byId('load-form').hidden = names.length === 0;
  }

  async ask(request) {
    if (this.isBusy) return {outcome: 'wrong', text: ''};
    this.setBusy(true);
    this.answer('', `${request} …`);
    const answer = await this.post(request);
    this.answer(answer.outcome, answer.text);
    this.setBusy(false);
    return answer;
  }

  async post(request) {
    try {
      const answer = await fetch('/control', {
        method: 'POST',
        headers: {'Authorization': `Bearer ${this.token}`, 'Content-Type': 'application/json'},
        body: JSON.stringify({request}),
      });
      if (answer.ok) return await answer.json();
      if (answer.status === 401) this.check();
      return {
        outcome: 'failed',
        text: `mocap view refused the request: ${answer.status} ${answer.statusText}`
      };
    } catch (error) {
      return {outcome: 'failed', text: `mocap view does not answer: ${error.message}`};
    }
  }

  setBusy(isBusy) {
    this.isBusy = isBusy;
    for (const button of byId('action-forms').querySelectorAll('button')) button.disabled = isBusy;
  }

  answer(outcome, text) {
    byId('answer').dataset.outcome = outcome;
    setText(byId('answer'), text.trimEnd());
    return {outcome, text};
  }
}
