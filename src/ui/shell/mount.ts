/** Builds the page around a workbench and its first frame. */
import '../styles/rest.css';
import type { CommandInfo } from '../../edit/commands/all.ts';
import { provideReuse } from '../../evaluate/compiled-take.ts';
import { RECOMPILED } from '../../evaluate/recompiled-take.ts';
import type { ThemeName } from '../../view/theme.ts';
import { outliner } from '../editors/outliner/outliner.ts';
import { offerOverSamples } from '../editors/posing/auto-key-samples.ts';
import { followForm } from '../editors/posing/mode-of-form.ts';
import { followKeyedPoses } from '../editors/posing/offer-moment.ts';
import { followOpened } from '../editors/posing/opened.ts';
import { followLoneSkins } from '../editors/rig/offer-skeleton.ts';
import { tellLocked } from '../editors/sets/tell-locked.ts';
import { takeCell } from '../editors/takes/take-cell.ts';
import { followCharacter } from '../editors/timeline/follow-character.ts';
import { followPeriods } from '../editors/timeline/period.ts';
import { Scrubber } from '../editors/transport/scrubber.ts';
import { transport } from '../editors/transport/transport.ts';
import { listenToKeys } from '../state/actions/keys.ts';
import { PageActions } from '../state/actions/page-actions.ts';
import { onDemand } from '../state/on-demand.ts';
import type { TimelineTab, TimelineTabName } from '../state/timeline.ts';
import type { ActionList, Workbench } from '../state/workbench.ts';
import type { Observable } from '../widgets/observable.ts';
import { openSelectsAsMenus } from '../widgets/select-menu.ts';
import { startTooltips } from '../widgets/tooltip/tooltip-layer.ts';
import { pageActions } from './actions.ts';
import { askAboutCycles } from './cycle-questions.ts';
import { startDialogs } from './dialogs.ts';
import { followFloor } from './floor.ts';
import { inspectorPanel } from './inspector-panel.ts';
import { layout } from './layout.ts';
import { menuBar } from './menu-bar.ts';
import { commands, runById } from './run-by-id.ts';
import { sheetBar } from './sheet-bar.ts';
import { leaveRefusalsBehind } from './stale-messages.ts';
import { keepKeys, replayKeys } from './start/early-keys.ts';
import { statusBar } from './status-bar.ts';
import { timelinePanel } from './timeline/timeline-panel.ts';
import { timelineSwitches } from './timeline/timeline-switches.ts';
import { TABS } from './timeline/timeline-tabs.ts';
import { limitUndo } from './undo-memory.ts';
import { viewportPane } from './viewport-pane.ts';

export interface Beginnings {
  /** The current theme. */
  readonly theme: Observable<ThemeName>;
  /** Sets the actions, for `Workbench.actions`. */
  setActions(all: ActionList): void;
}

/** The page once it is built. */
export interface MountedPage {
  /** Resolves when all panels have their content. */
  readonly filled: Promise<void>;
  /** For `marrow.run`: a command or an action by its id; returns a promise if it is loaded first. */
  run(id: string, args: Readonly<Record<string, unknown>>): Promise<void> | undefined;
  /** For `marrow.commands`. */
  commands(): Promise<readonly CommandInfo[]>;
}

/**
 * Builds the page in `root`, which has the first frame (`first-picture.ts`), and keeps it in sync with the workbench.
 * `signal` removes the listeners on window and document.
 */
export function mountWorkbench(
  root: HTMLElement,
  wb: Workbench,
  { theme, setActions }: Beginnings,
  signal: AbortSignal,
): MountedPage {
  provideReuse(RECOMPILED);
  // Before anything that shows actions.
  const actions = new PageActions(
    () => pageActions(wb),
    () => wb,
  );
  setActions(actions);
  const scrubber = new Scrubber(wb);
  const tabs: TimelineTab[] = [];
  const loadTab = async (name: TimelineTabName) => {
    const tab = await TABS[name].load(wb);
    tabs.push(tab);
    return tab;
  };
  const recolour = () => {
    scrubber.redraw(true);
    for (const tab of tabs) tab.recolour();
  };
  const stops = [
    leaveRefusalsBehind(wb),
    followCharacter(wb),
    followOpened(wb),
    followForm(wb),
    followFloor(wb),
    followPeriods(wb),
    askAboutCycles(wb),
    limitUndo(wb),
    offerOverSamples(wb),
    tellLocked(wb),
    followKeyedPoses(wb),
    followLoneSkins(wb),
    followMoments(wb, scrubber.element),
    followTweens(wb, scrubber.element),
    theme.subscribe(recolour),
  ];
  signal.addEventListener('abort', () => {
    for (const stop of stops) stop();
  });
  const stage = viewportPane(wb, signal);
  const inspector = inspectorPanel(wb, signal);
  const timeline = timelinePanel(wb, [takeCell(wb), scrubber.element], loadTab, signal);
  const tabSwitches = timelineSwitches(wb, () => timeline.goTo(), signal);
  layout(
    wb,
    root,
    {
      menuBar: menuBar(wb),
      outliner: outliner(wb),
      stage,
      inspector: inspector.element,
      transport: transport(wb, tabSwitches),
      timeline: timeline.element,
      status: statusBar(wb, signal),
      sheetBar: sheetBar(wb, signal),
    },
    tabSwitches,
    signal,
  );
  startDialogs(wb, root);
  startTooltips(signal);
  openSelectsAsMenus(signal);
  listenToKeys(wb, signal);
  return { filled: inspector.filled, run: (id, args) => runById(wb, id, args), commands };
}

/** So is the bar for values between keys, in which whoever has pressed its key types on at once. */
function followTweens(wb: Workbench, ruler: HTMLElement): () => void {
  let stop = () => {};
  stop = wb.timeline.tween.subscribe(async () => {
    stop();
    const loaded = new AbortController();
    const early = keepKeys(loaded.signal, () => wb.timeline.tween.update(() => undefined));
    const module = await onDemand(
      wb.messages,
      'The bar for values between keys',
      () => import('../editors/tween/bar.ts'),
    );
    loaded.abort();
    if (module && ruler.parentElement) replayKeys(early, module.tweenBar(wb, ruler.parentElement));
  });
  return () => stop();
}

/** The band of a moment is a script of its own, loaded with the first. */
function followMoments(wb: Workbench, ruler: HTMLElement): () => void {
  let stop = () => {};
  stop = wb.timeline.moment.subscribe(async () => {
    stop();
    const module = await onDemand(
      wb.messages,
      'The band of a moment',
      () => import('../editors/transport/moment-band.ts'),
    );
    module?.momentBand(wb, ruler);
  });
  return () => stop();
}
