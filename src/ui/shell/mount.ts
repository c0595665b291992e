/** Builds the page around a workbench: the one function that `main.ts` calls. */
import { outliner } from '../editors/outliner/outliner.ts';
import { followCharacter } from '../editors/timeline/follow-character.ts';
import { followPeriods } from '../editors/timeline/period.ts';
import { startPlayer } from '../editors/transport/player.ts';
import { Scrubber } from '../editors/transport/scrubber.ts';
import { transport } from '../editors/transport/transport.ts';
import { listenToKeys } from '../state/keys.ts';
import type { TimelineTab, TimelineTabName } from '../state/timeline.ts';
import type { Workbench } from '../state/workbench.ts';
import { startDialogs } from './dialogs.ts';
import { dropTarget } from './drop-target.ts';
import { inspectorPanel } from './inspector-panel.ts';
import { layout } from './layout.ts';
import { menuBar } from './menu-bar.ts';
import { leaveRefusalsBehind } from './stale-messages.ts';
import { followTheme } from './theme.ts';
import { timelinePanel } from './timeline-panel.ts';
import { viewportPane } from './viewport-pane.ts';

/** Each is a script of its own. */
async function buildTab(wb: Workbench, name: TimelineTabName): Promise<TimelineTab> {
  switch (name) {
    case 'curves':
      return (await import('../editors/curves/panel.ts')).curvePanel(wb);
    case 'dope':
      return (await import('../editors/dope/panel.ts')).dopePanel(wb);
    case 'takes':
      return (await import('../editors/takes/panel.ts')).takesPanel(wb);
    case 'poses':
      return (await import('../editors/poses/panel.ts')).posesPanel(wb);
  }
}

/**
 * Builds the page in `root` and keeps it in step with the workbench: viewport and document, transport and clock, theme
 * and system. `signal` takes the listeners on window and document away again.
 */
export function mountWorkbench(root: HTMLElement, wb: Workbench, signal = new AbortController().signal): void {
  const stopFollowing = [leaveRefusalsBehind(wb), followCharacter(wb), followPeriods(wb)];
  signal.addEventListener('abort', () => {
    for (const stop of stopFollowing) stop();
  });
  const scrubber = new Scrubber(wb);
  const tabs: TimelineTab[] = [];
  const loadTab = async (name: TimelineTabName) => {
    const tab = await buildTab(wb, name);
    tabs.push(tab);
    return tab;
  };
  followTheme(wb, signal, () => {
    scrubber.redraw(true);
    for (const tab of tabs) tab.recolour();
  });
  const stage = viewportPane(wb, signal);
  layout(
    wb,
    root,
    {
      menuBar: menuBar(wb),
      outliner: outliner(wb),
      stage,
      inspector: inspectorPanel(wb),
      transport: transport(wb, scrubber),
      timeline: timelinePanel(wb, loadTab, signal),
    },
    signal,
  );
  root.append(dropTarget(wb, signal));
  startDialogs(wb, root);
  startPlayer(wb, signal);
  listenToKeys(wb, signal);
}
