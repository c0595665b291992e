/** One row of the list: cells created once, and updated for another take. */
import type { Flag } from '../../../review/flags.ts';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { count, duration, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import type { ReviewRow } from './rows.ts';
import { amountText, flagsText, starsText, worstText } from './texts.ts';
import { Thumbnail } from './thumbnail.ts';

export interface RowState {
  /** The flag whose size is stated. */
  readonly worst: Flag | undefined;
  readonly chosen: boolean;
  /** Whether its thumbnail plays. */
  readonly plays: boolean;
}

export class ReviewRowView {
  readonly element: HTMLElement;
  private readonly thumbnail = new Thumbnail();
  private readonly name = middleCut('');
  private readonly nameCell = cell('review-name', this.name.element);
  private readonly verdict = cell('review-verdict');
  private readonly stars = cell('review-stars');
  private readonly seconds = cell('number');
  private readonly frames = cell('number review-frames');
  private readonly fps = cell('number review-fps');
  private readonly joints = cell('number review-joints');
  private readonly flags = cell('review-flags');
  private readonly worst = cell('number review-worst');
  private readonly tags = cell('review-tags');
  private readonly notes = cell('review-notes');

  constructor() {
    this.element = element(
      'div',
      { class: 'sort-row review-row', role: 'row' },
      cell('review-picture', this.thumbnail.element),
      this.nameCell,
      this.verdict,
      this.stars,
      this.seconds,
      this.frames,
      this.fps,
      this.joints,
      this.flags,
      this.worst,
      this.tags,
      this.notes,
    );
  }

  show({ take, name, digest, hasFile }: ReviewRow, { worst, chosen, plays }: RowState): void {
    const found = digest?.found;
    setAttribute(this.element, 'aria-selected', String(chosen));
    write(this.element.dataset, 'verdict', take.verdict);
    this.element.classList.toggle('no-file', !hasFile);
    this.thumbnail.show(found?.figure, plays);
    this.name.show(name);
    setTooltip(this.nameCell, take.path);
    setText(this.verdict, take.verdict === '' ? '' : take.verdict === 'good' ? 'Good' : 'Bad');
    setText(this.stars, starsText(take.stars));
    setAttribute(this.stars, 'aria-label', take.stars > 0 ? `${take.stars} of 5 stars` : 'No stars');
    const facts = found?.facts;
    setText(this.seconds, facts ? duration(facts.seconds) : '');
    setText(this.frames, facts ? count(facts.frames) : '');
    setText(this.fps, facts ? shown(facts.fps, 2) : '');
    setText(this.joints, facts ? count(facts.joints) : '');
    const flags = facts ? flagsText(facts.flags) : (digest?.problem ?? (hasFile ? '…' : 'No file'));
    setText(this.flags, flags);
    setTooltip(this.flags, flags.length > 1 ? flags : undefined);
    this.flags.classList.toggle('faint', !facts);
    setText(this.worst, worst ? amountText(worst) : '');
    setTooltip(this.worst, worst && worstText(worst));
    setText(this.tags, take.tags.join(', '));
    setTooltip(this.tags, take.tags.join(', ') || undefined);
    setText(this.notes, take.notes);
    setTooltip(this.notes, take.notes || undefined);
  }
}

function cell(className: string, ...children: Node[]): HTMLElement {
  return element('div', { role: 'gridcell', class: `sort-cell ${className}` }, ...children);
}
