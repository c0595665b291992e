/** The card of a guide in the viewport: its steps, which tick themselves off as the document changes. */

import { tryById } from '../../../state/actions/action.ts';
import type { GuideName } from '../../../state/guide.ts';
import { manualAnchor } from '../../../state/manual-link.ts';
import { isPanelOpen } from '../../../state/panels/panels.ts';
import { onResult } from '../../../state/shown-comparison.ts';
import type { Workbench } from '../../../state/workbench.ts';
import { button, element, setAttribute, write } from '../../../widgets/dom.ts';
import { icon } from '../../../widgets/icons.ts';
import { touchWords } from '../../../widgets/touch-words.ts';
import { advanced, GUIDE_TEXTS, type GuideProgress, type GuideState, type GuideStep } from './steps.ts';

export interface GuideCard {
  readonly element: HTMLElement;
  /** Stops following the document. */
  end(): void;
}

export function guideCard(wb: Workbench, name: GuideName): GuideCard {
  const guide = GUIDE_TEXTS[name];
  let progress: GuideProgress = { done: 0, since: stateOf(wb) };
  const rows = guide.steps.map((step, i) => stepRow(wb, step, i));
  const finished = element(
    'p',
    { class: 'guide-finished' },
    'Done. ',
    manualAnchor('Read on in the manual', guide.page),
  );
  const said = element('p', { class: 'off-screen', role: 'status' });
  const card = element(
    'section',
    { class: 'guide', 'aria-label': guide.title },
    element(
      'div',
      { class: 'guide-head' },
      element('h2', {}, guide.title),
      button(`Close ${guide.title}`, { class: 'tool small' }, icon('close'), () => wb.guide.set(undefined)),
    ),
    element('p', { class: 'faint' }, guide.about),
    element('ol', {}, ...rows),
    finished,
    said,
  );
  const show = () => {
    const { done } = progress;
    rows.forEach((row, i) => {
      row.classList.toggle('done', i < done);
      row.classList.toggle('next', i === done);
      if (i === done) setAttribute(row, 'aria-current', 'step');
      else row.removeAttribute('aria-current');
    });
    write(finished, 'hidden', done < rows.length);
  };
  const follow = () => {
    const next = advanced(guide, progress, stateOf(wb));
    if (next === progress) return;
    progress = next;
    const step = guide.steps[progress.done];
    said.textContent = step ? `Step ${progress.done + 1}: ${step.what} ${step.how}` : `${guide.title}: done`;
    show();
  };
  const stops = [
    // Previews may be cancelled, so documents count only by their steps.
    wb.store.onStep(follow),
    wb.store.subscribe((now, before) => {
      if (now.selection !== before.selection || now.document.characters.length !== before.document.characters.length)
        follow();
    }),
    wb.transport.subscribe(follow),
    wb.settings.subscribe(follow),
    wb.timeline.view.subscribe(follow),
    wb.files.unsaved.subscribe(follow),
    onResult(wb, follow),
  ];
  progress = advanced(guide, progress, progress.since);
  show();
  return {
    element: card,
    end() {
      for (const stop of stops) stop();
      card.remove();
    },
  };
}

function stepRow(wb: Workbench, { what, how, action }: GuideStep, index: number): HTMLElement {
  const row = element(
    'li',
    {},
    element('span', { class: 'guide-mark', 'aria-hidden': 'true' }, String(index + 1)),
    element('span', {}, element('b', {}, touchWords(what)), ` ${touchWords(how)}`),
  );
  if (action) {
    const [label, id] = action;
    row.append(button(label, { class: 'plain', tooltip: undefined }, label, () => tryById(wb, id)));
  }
  return row;
}

function stateOf({ store, transport, settings, timeline, files, comparing }: Workbench): GuideState {
  const { playing, timeSeconds } = transport.get();
  const compared = comparing.get()?.state.get();
  return {
    document: store.document,
    selection: store.selection,
    isPlaying: playing,
    time: timeSeconds,
    tab: isPanelOpen(settings.get(), 'timeline') ? timeline.view.get().tab : undefined,
    isUnsaved: files.unsaved.get().length > 0,
    comparing: compared?.result && compared.dumps,
  };
}
