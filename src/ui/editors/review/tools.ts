/** Controls of the review, beside the tabs: filters, verdicts and stars for the selected takes, opening and saving. */
import { MAX_STARS } from '../../../model/takes/review.ts';
import { FLAG_KINDS } from '../../../review/flags.ts';
import { findAction, isEnabled, tryAction } from '../../state/actions/action.ts';
import { itemOf } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { ReviewView } from '../../state/review.ts';
import type { Workbench } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { focusPanel } from '../../widgets/focus/focus.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { count } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { isFiltered, kindListed, tagsIn } from './rows.ts';
import { atLeastText, FLAG_NAMES, starsText } from './texts.ts';

/** Of flags of one kind, by how bad they are. */
const SIZES = [1, 2, 5, 10];

export interface ReviewTools {
  readonly element: HTMLElement;
  /** @param listed number of takes that the filters leave */
  show(listed: number): void;
}

export function reviewTools(wb: Workbench): ReviewTools {
  const { review } = wb.timeline;
  const refreshing: (() => void)[] = [];
  const act = (id: string, label: string, content: string | Node) => {
    const action = findAction(wb, id);
    const made = keepsFocusElsewhere(
      button(label, { class: 'tool text-tool' }, content, () => action && tryAction(wb, action)),
    );
    setActionTooltip(wb, made, id, label);
    refreshing.push(() => {
      write(made, 'disabled', !(action && isEnabled(wb, action)));
    });
    return made;
  };
  const filter = element('input', {
    type: 'search',
    'aria-label': 'Filter takes in review',
    placeholder: 'Filter',
    spellcheck: 'false',
    autocomplete: 'off',
  });
  filter.addEventListener('input', () => review.change({ text: filter.value }));
  filter.addEventListener('keydown', (event) => {
    if (event.isComposing) return;
    if (event.key === 'Escape' && filter.value) review.change({ text: '' });
    else if (event.key === 'Enter' || event.key === 'ArrowDown') focusPanel(filter);
    else return;
    event.preventDefault();
  });
  const only = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'tool text-tool' }, 'Show only', icon('fold')),
  );
  setTooltip(only, 'List only takes with a verdict, flags, stars or a tag');
  menuButton(only, 'Show only', () => onlyEntries(wb));
  const open = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'tool text-tool' }, 'Open', icon('fold')),
  );
  setTooltip(open, 'Open takes as characters, or save the list');
  menuButton(open, 'Open or save', () =>
    ['review.open', 'review.openGood', 'line', 'review.saveCsv', 'review.saveJson'].flatMap((id): MenuEntry[] => {
      const action = findAction(wb, id);
      return action ? [itemOf(wb, action)] : id === 'line' ? [{ kind: 'line' }] : [];
    }),
  );
  const counted = element('span', { class: 'review-count', role: 'status' });
  const tools = element(
    'div',
    { class: 'review-tools' },
    element('div', { class: 'search review-filter' }, icon('search'), filter),
    toolbar(
      element(
        'div',
        { class: 'tools', 'aria-label': 'Review' },
        only,
        act('review.previous', 'Previous take', icon('previousTake')),
        act('review.next', 'Next take', icon('nextTake')),
        act('review.good', 'Good', 'Good'),
        act('review.bad', 'Bad', 'Bad'),
        open,
      ),
    ),
    counted,
  );
  return {
    element: tools,
    show(listed) {
      for (const refresh of refreshing) refresh();
      const view = review.view.get();
      if (filter.value !== view.text) filter.value = view.text;
      only.classList.toggle('on', isFiltered({ ...view, text: '' }));
      setAttribute(only, 'aria-label', `Show only: ${onlyText(view)}`);
      setText(counted, countText(wb, listed));
    },
  };
}

/** `12 of 3,000 takes, 40 selected; 1,200 read`. */
function countText({ store, timeline }: Workbench, listed: number): string {
  const { review } = timeline;
  const { length } = store.document.review ?? [];
  const { size } = review.view.get().chosen;
  const progress = review.files.get()?.progress.get();
  const takes = listed === length ? `${count(length)} takes` : `${count(listed)} of ${count(length)} takes`;
  const chosen = size > 1 ? `, ${count(size)} selected` : '';
  const reading = progress && progress.done < progress.of ? `; ${count(progress.done)} checked` : '';
  return `${takes}${chosen}${reading}`;
}

function onlyText(view: ReviewView): string {
  const { verdict, flag, bad, tag, stars } = view;
  const kind = kindListed(view);
  const parts = [
    verdict === '' ? 'no verdict' : verdict,
    kind && bad !== undefined ? `${kind} of ${atLeastText(kind, bad)}` : flag,
    tag,
    stars > 0 ? `${stars} stars or more` : undefined,
  ].filter((part) => part !== undefined);
  return parts.length > 0 ? parts.join(', ') : 'all';
}

function onlyEntries({ store, timeline }: Workbench): MenuEntry[] {
  const { review } = timeline;
  const view = review.view.get();
  const { verdict: _v, flag: _f, bad: _b, tag: _t, ...rest } = view;
  const item = (label: string, checked: boolean, next: ReviewView): MenuEntry => ({
    kind: 'item',
    label,
    enabled: true,
    checked,
    radio: true,
    run: () => review.view.set(next),
  });
  const without = (...keys: readonly ('verdict' | 'flag' | 'bad' | 'tag')[]): ReviewView => {
    const others = { ...view };
    for (const key of keys) delete others[key];
    return others;
  };
  const verdicts = [
    item('Any verdict', view.verdict === undefined, without('verdict')),
    item('Good', view.verdict === 'good', { ...view, verdict: 'good' }),
    item('Bad', view.verdict === 'bad', { ...view, verdict: 'bad' }),
    item('No verdict', view.verdict === '', { ...view, verdict: '' }),
  ];
  // How bad is said of one kind.
  const flagged = (flag: NonNullable<ReviewView['flag']>): ReviewView => ({ ...without('bad'), flag });
  const flags = [
    item('With or without flags', view.flag === undefined, without('flag', 'bad')),
    item('Any flag', view.flag === 'any', flagged('any')),
    item('No flags', view.flag === 'none', flagged('none')),
    ...FLAG_KINDS.map((flag) => item(FLAG_NAMES[flag], view.flag === flag, flagged(flag))),
  ];
  const kind = kindListed(view);
  const sizes = kind
    ? [
        item('Any size', view.bad === undefined, without('bad')),
        ...SIZES.map((bad) => item(atLeastText(kind, bad), view.bad === bad, { ...view, bad })),
      ]
    : [];
  const stars = Array.from({ length: MAX_STARS + 1 }, (_, n) =>
    item(n === 0 ? 'Any stars' : `${starsText(n)}${n < MAX_STARS ? ' or more' : ''}`, view.stars === n, {
      ...view,
      stars: n,
    }),
  );
  const tags = tagsIn(store.document.review ?? []);
  const tagged = [
    item('Any tag', view.tag === undefined, without('tag')),
    ...tags.map((tag) => item(tag, view.tag === tag, { ...view, tag })),
  ];
  return [
    {
      kind: 'item',
      label: 'All takes',
      enabled: isFiltered(view),
      run: () => review.view.set({ ...rest, text: '', stars: 0 }),
    },
    { kind: 'line' },
    { kind: 'menu', label: 'Verdict', entries: () => verdicts },
    { kind: 'menu', label: 'Flags', entries: () => flags },
    ...(sizes.length > 0 ? [{ kind: 'menu', label: 'Size of flag', entries: () => sizes } as const] : []),
    { kind: 'menu', label: 'Stars', entries: () => stars },
    ...(tags.length > 0 ? [{ kind: 'menu', label: 'Tag', entries: () => tagged } as const] : []),
  ];
}
