/**
 * The timeline: the ruler with the current take beside it, and below it what is seen of curve editor, dope sheet and
 * the other tabs, with their tools above the ruler and a splitter for the height. Collapsed, only the ruler remains.
 * The tabs are scripts of their own, so that the page shows its character first.
 */
import { movedNotice } from '../../editors/retarget/moved.ts';
import { onDemand, whenIdle } from '../../state/on-demand.ts';
import { isPanelOpen, NARROW } from '../../state/panels/panels.ts';
import { splitter } from '../../state/panels/splitter.ts';
import { shownTabs, TIMELINE_TABS, type TimelineTab, type TimelineTabName } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { focusPanel } from '../../widgets/focus/focus.ts';
import { returnFocus } from '../../widgets/focus/focus-regions.ts';
import { TABS } from './timeline-tabs.ts';

export interface TimelinePanel {
  readonly element: HTMLElement;
  /** Moves the focus into the tab that is shown next, or now. */
  goTo(): void;
}

interface Place {
  readonly name: TimelineTabName;
  readonly names: HTMLElement;
  readonly tools: HTMLElement;
  readonly body: HTMLElement;
  /** Until it is loaded. */
  readonly waiting: HTMLElement;
}

type Parts = Uses<'store' | 'timeline' | 'settings' | 'messages' | 'loading' | 'dialog'>;

/**
 * @param ruler the scrubber, and what is beside it
 * @param load loads and builds a tab; called once, when it is first shown; for the initial tab not before the page is
 *   idle, since the first frame has priority
 */
export function timelinePanel(
  wb: Parts,
  ruler: readonly HTMLElement[],
  load: (name: TimelineTabName) => Promise<TimelineTab>,
  signal: AbortSignal,
): TimelinePanel {
  return new Panel(wb, ruler, load, signal);
}

class Panel implements TimelinePanel {
  readonly element: HTMLElement;
  private readonly places: readonly Place[];
  private readonly edge: HTMLElement;
  private readonly head: HTMLElement;
  private readonly bodies: HTMLElement;
  /** Between the dope sheet and the curves. */
  private readonly between: HTMLElement;
  private readonly built = new Map<TimelineTabName, TimelineTab>();
  private readonly asked = new Set<Place>();
  private isStarting = true;
  /** The tab that was clicked, which gets the focus once it is loaded, unless another one is shown before. */
  private goneTo: TimelineTabName | undefined;
  private handsOver = false;

  constructor(
    private readonly wb: Parts,
    ruler: readonly HTMLElement[],
    private readonly load: (name: TimelineTabName) => Promise<TimelineTab>,
    private readonly signal: AbortSignal,
  ) {
    const { timeline } = wb;
    this.places = TIMELINE_TABS.map((name) => placeOf(timeline, name));
    this.edge = splitter(wb, 'timelineHeight', 'Height of the timeline');
    this.head = element('div', { class: 'timeline-head' }, ...this.places.flatMap((p) => [p.names, p.tools]));
    this.between = splitter(wb, 'dopeHeight', 'Height of the dope sheet');
    // The dope sheet is above the curves.
    const [dope, others] = [true, false].map((isDope) => this.places.filter((p) => (p.name === 'dope') === isDope));
    this.bodies = element(
      'div',
      { class: 'timeline-bodies' },
      ...dope.map((p) => p.body),
      this.between,
      ...others.map((p) => p.body),
    );
    this.element = element(
      'section',
      { class: 'timeline', 'aria-label': 'Timeline', 'data-panel': 'timeline' },
      this.edge,
      this.head,
      element('div', { class: 'time-row' }, ...ruler),
      movedNotice(wb),
      this.bodies,
    );
    timeline.view.subscribe((now, before) => {
      if (now.tab !== before.tab || now.together !== before.together) this.show();
    });
    wb.settings.subscribe((now, before) => {
      if (now.panels !== before.panels) this.show();
    });
    window.matchMedia(NARROW).addEventListener('change', () => this.show(), { signal });
    this.show();
    this.isStarting = false;
  }

  goTo(): void {
    this.goneTo = this.wb.timeline.view.get().tab;
    this.show();
  }

  private async build({ name, names, tools, body, waiting }: Place): Promise<void> {
    const what = `The ${TABS[name].label.toLowerCase()}`;
    const tab = await onDemand(this.wb.messages, what, () => this.load(name));
    if (!tab) setText(waiting, `${what} could not be loaded.`);
    if (!tab || this.signal.aborted) return;
    this.built.set(name, tab);
    if (tab.names) names.append(tab.names);
    if (tab.tools) tools.append(tab.tools);
    body.replaceChildren(tab.element);
    this.show();
  }

  private need(place: Place): void {
    if (this.asked.has(place)) return;
    this.asked.add(place);
    if (this.isStarting) whenIdle(this.wb, () => void this.build(place));
    else void this.build(place);
  }

  private show(): void {
    const { wb, places, edge, head, bodies, between, built } = this;
    const { timeline } = wb;
    const view = timeline.view.get();
    const isOpen = isPanelOpen(wb.settings.get(), 'timeline');
    const shown = isOpen ? shownTabs(view) : [];
    const hadFocus = bodies.contains(document.activeElement) || head.contains(document.activeElement);
    this.element.classList.toggle('folded', !isOpen);
    for (const each of [edge, bodies]) write(each, 'hidden', !isOpen);
    write(between, 'hidden', shown.length < 2);
    bodies.classList.toggle('together', shown.length > 1);
    timeline.tab = isOpen ? built.get(view.tab) : undefined;
    this.handsOver ||= places.some((p) => isOpen && !shown.includes(p.name) && p.body.contains(document.activeElement));
    // Of both, one filter of names does.
    const named = places.find((p) => shown.includes(p.name) && built.get(p.name)?.names);
    let hasTools = false;
    for (const place of places) {
      const { name, names, tools, body } = place;
      const isShown = shown.includes(name);
      if (isShown) this.need(place);
      write(names, 'hidden', place !== named);
      for (const each of [body, tools]) write(each, 'hidden', !isShown);
      hasTools ||= isShown && tools.childElementCount > 0;
      built.get(name)?.setVisible(isShown);
    }
    write(head, 'hidden', !hasTools);
    if (hadFocus && !isOpen) returnFocus();
    if (!isOpen) this.goneTo = undefined;
    if (timeline.tab) this.handOver(view.tab);
  }

  /** The focused element was hidden, so the keyboard would be dead. A tab being loaded gets the focus when ready. */
  private handOver(tab: TimelineTabName): void {
    const isGoneTo = this.goneTo === tab;
    this.goneTo = undefined;
    if (!this.handsOver && !isGoneTo) return;
    const { activeElement } = document;
    if (isGoneTo || this.element.contains(activeElement) || activeElement === document.body) focusPanel(this.element);
    this.handsOver = false;
  }
}

function placeOf(timeline: Parts['timeline'], name: TimelineTabName): Place {
  const waiting = element('p', { class: 'empty' }, `${TABS[name].label} …`);
  const body = element(
    'div',
    { class: 'timeline-body', role: 'tabpanel', 'aria-labelledby': `timeline-tab-${name}`, 'data-tab': name },
    waiting,
  );
  // Of two tabs that are seen, keys are for the one that was worked in last.
  for (const type of ['focusin', 'pointerdown'] as const) {
    body.addEventListener(type, () => {
      if (timeline.view.get().tab !== name) timeline.change({ tab: name });
    });
  }
  const names = element('div', { class: 'timeline-names' });
  return { name, names, tools: element('div', { class: 'timeline-tools' }), body, waiting };
}
