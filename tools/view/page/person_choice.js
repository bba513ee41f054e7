// Whose sizes are kept: one of those who are followed, by number.

const PLACEHOLDER = {
  text: 'whose?',
  value: '',
  selected: true
};

export class PersonChoice {
  constructor() {
    this.rows = [];
    this.value = '';      // the number; '' while nobody has one
    this.isGone = false;  // whoever was chosen has left, and another is never taken for him
  }

  /** Takes who is followed: `id` and `label` of each, whoever has been followed longest first. */
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

  /** @return texts and values of a list; the chosen one is `selected`. */
  options() {
    const options = this.rows.map((row) => ({...row, selected: row.value === this.value}));
    return this.isGone ? [PLACEHOLDER, ...options] : options;
  }
}
