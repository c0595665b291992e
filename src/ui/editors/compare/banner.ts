/** The banner over the viewport: what a comparison found, in sentences, and where to look at it. */

import type { DumpComparison } from '../../state/dump-comparison.ts';
import { takeTimeShown } from '../../state/dump-times.ts';
import { isPanelOpen, openPanel } from '../../state/panels/panels.ts';
import { showInSource } from '../../state/panels/show-in-source.ts';
import { endComparison } from '../../state/shown-comparison.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { icon } from '../../widgets/icons.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { type BannerText, bannerText } from './banner-text.ts';

type Parts = Uses<'comparing' | 'store' | 'transport' | 'timeline' | 'settings'>;

/** Fills an element, which is hidden while nothing is compared. */
export function fillBanner(wb: Parts, banner: HTMLElement): void {
  const mark = element('span', { class: 'compare-tone' });
  const text = element('span', { class: 'offer-text', role: 'status' });
  const progress = element('progress', { max: 1, 'aria-label': 'Comparing' });
  const act = (label: string, run: (comparing: DumpComparison) => void) =>
    button(label, { class: 'link', tooltip: undefined }, label, () => {
      const comparing = wb.comparing.get();
      if (comparing) run(comparing);
    });
  let now: BannerText | undefined;
  const cancel = act('Cancel', (comparing) => comparing.cancel());
  const again = act('Compare again', (comparing) => comparing.again());
  const goTo = act('', (comparing) => {
    if (now?.goTo !== undefined) comparing.goToTime(now.goTo);
  });
  const line = act('', () => {
    if (now?.problem) showInSource(wb, now.problem);
  });
  const details = act('Details', () => {
    openPanel(wb, 'timeline', true);
    wb.timeline.change({ tab: 'compare' });
  });
  const close = button('Stop comparing', { class: 'tool small' }, icon('close'), () => endComparison(wb));
  const acts = element('span', { class: 'compare-acts' }, progress, goTo, line, details, again, cancel);
  banner.append(mark, text, acts, close);

  const show = () => {
    const comparing = wb.comparing.get();
    write(banner, 'hidden', comparing === undefined);
    if (!comparing) return;
    const { character } = comparing;
    now = bannerText({
      state: comparing.state.get(),
      character,
      frame: comparing.shown.get()?.index ?? -1,
      time: takeTimeShown(wb, character),
      isNamed: wb.store.document.characters.length > 1,
    });
    write(banner.dataset, 'tone', now.tone);
    setText(text, now.text);
    for (const each of [progress, cancel]) write(each, 'hidden', now.share === undefined);
    progress.value = now.share ?? 0;
    write(goTo, 'hidden', now.goTo === undefined);
    label(goTo, `Go to ${shown(now.goTo ?? 0, 4)} s`);
    write(line, 'hidden', !now.problem || now.problem.line === 0);
    label(line, `Line ${now.problem?.line ?? 0}`);
    write(again, 'hidden', !now.canRetry);
    const isOpen = isPanelOpen(wb.settings.get(), 'timeline') && wb.timeline.view.get().tab === 'compare';
    write(details, 'hidden', isOpen || comparing.state.get().result === undefined);
  };
  const showSoon = oncePerFrame(show);
  let stops: (() => void)[] = [];
  const follow = (comparing: DumpComparison | undefined) => {
    for (const stop of stops) stop();
    stops = comparing ? [comparing.state.subscribe(showSoon), comparing.shown.subscribe(showSoon)] : [];
    show();
  };
  wb.comparing.subscribe(follow);
  wb.timeline.view.subscribe((is, was) => {
    if (is.tab !== was.tab) showSoon();
  });
  wb.settings.subscribe(showSoon);
  wb.store.subscribe((is, was) => {
    if (is.document !== was.document && wb.comparing.get()) showSoon();
  });
  follow(wb.comparing.get());
}

function label(target: HTMLElement, text: string): void {
  setText(target, text);
  setAttribute(target, 'aria-label', text);
}
