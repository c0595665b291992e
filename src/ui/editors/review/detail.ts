/** Beside the list: the flags of the take with the focus, each of which leads to its moment, and its tags and notes. */
import type { Review } from '../../../model/takes/review.ts';
import type { Flag } from '../../../review/flags.ts';
import { manualLink } from '../../state/manual-link.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { flagItem } from './flag-item.ts';
import type { ReviewRow } from './rows.ts';

export interface DetailEvents {
  /** Of the selected takes. */
  change(review: Partial<Review>): void;
  seek(flag: Flag): void;
}

export class ReviewDetail {
  readonly element: HTMLElement;
  private readonly name = middleCut('');
  private readonly heading = element('h3', { class: 'review-heading' }, this.name.element);
  private readonly flags = element('ul', { class: 'review-flag-list', 'aria-label': 'Flags' });
  private readonly none = element('p', { class: 'faint review-none' });
  private readonly tags = element('input', {
    type: 'text',
    class: 'review-field',
    spellcheck: 'false',
    autocomplete: 'off',
    placeholder: 'walk, calm',
  });
  private readonly notes = element('textarea', { class: 'review-field', rows: 2 });
  private readonly explained = manualLink('What do flags mean?', 'flags');
  private readonly tagsLabel = element('span');
  private readonly notesLabel = element('span');
  private listed: readonly Flag[] | undefined;

  constructor(private readonly events: DetailEvents) {
    this.tags.addEventListener('change', () => events.change({ tags: this.tags.value.split(',') }));
    this.notes.addEventListener('change', () => events.change({ notes: this.notes.value }));
    this.element = element(
      'div',
      { class: 'review-detail' },
      this.heading,
      element('label', { class: 'review-label' }, this.tagsLabel, this.tags),
      element('label', { class: 'review-label' }, this.notesLabel, this.notes),
      this.none,
      this.flags,
      this.explained,
    );
  }

  /** @param count of the selected takes, which tags and notes are for */
  show(row: ReviewRow | undefined, count: number): void {
    write(this.element, 'hidden', row === undefined);
    if (!row) return;
    const { take, digest } = row;
    this.name.show(row.name);
    setTooltip(this.heading, take.path);
    const all = count > 1 ? ` of ${count} takes` : '';
    setText(this.tagsLabel, `Tags${all}`);
    setText(this.notesLabel, `Notes${all}`);
    if (document.activeElement !== this.tags) this.tags.value = take.tags.join(', ');
    if (document.activeElement !== this.notes) this.notes.value = take.notes;
    const found = digest?.found?.facts.flags;
    const reading = row.hasFile ? 'Reading …' : 'Its file is missing. Drop its folder again.';
    setText(this.none, found ? (found.length === 0 ? 'No flags.' : '') : (digest?.problem ?? reading));
    write(this.none, 'hidden', this.none.textContent === '');
    if (found === this.listed) return;
    this.listed = found;
    write(this.explained, 'hidden', !found?.length);
    this.flags.replaceChildren(...(found ?? []).map((flag) => flagItem(flag, this.events.seek)));
  }
}
