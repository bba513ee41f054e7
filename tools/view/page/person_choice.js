// Choice of the tracked person whose sizes are saved, by number.

const PLACEHOLDER = {
  text: 'whose?',
  value: '',
  selected: true
};

export class PersonChoice {
  constructor() {
    this.rows = [];
    this.value = '';      // the number; '' while nobody has one
    this.isGone = false;  // the chosen person left; no other is ever taken instead
  }

  /** Sets the people: `id` and `label` of each; the person tracked longest is first. */
  take(rows) {
    this.rows = rows.map(({id, label}) => ({text: label, value: id > 0 ? String(id) : ''}));
    if (rows.length === 0) {
      this.value = '';
      this.isGone = false;
    } else if (this.value !== '' && !this.rows.some((row) => row.value === this.value)) {
      this.value = '';
      this.isGone = true;
    } else if (this.value === '' && !this.isGone) {
      this.value = this.rows[0].value;
    }
  }

  choose(value) {
    this.value = value;
    this.isGone = value === '';
  }

  /** @return whether there is anything to choose. */
  get isOffered() {
    return this.rows.length > 1 || this.isGone;
  }

  /** @return texts and values of a list; `selected` marks the chosen one. */
  options() {
    const options = this.rows.map((row) => ({...row, selected: row.value === this.value}));
    return this.isGone ? [PLACEHOLDER, ...options] : options;
  }
}
