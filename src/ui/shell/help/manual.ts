/**
 * *Help > Manual*, and F1, which opens the page of the manual about what has the focus. It is in the inspector's place;
 * while a dialog is open, in a window, since nothing behind a dialog can be read or scrolled.
 */

import { type ManualPage, showManual } from '../../state/manual-link.ts';
import { activePanel } from '../../state/panels/active-panel.ts';
import type { PosingMode } from '../../state/posing.ts';
import type { TimelineTabName } from '../../state/timeline.ts';
import type { DialogName, Uses } from '../../state/workbench.ts';
import { REGION } from '../../widgets/focus/focus.ts';

const CONTENTS: ManualPage = 'index.html';
const CLEAN_UP: ManualPage = 'guide/curves.html#clean-up';
const TAKES: ManualPage = 'guide/capture-and-review.html#edit-takes';

const DIALOGS: Readonly<Record<DialogName, ManualPage>> = {
  shortcuts: 'reference/shortcuts.html',
  search: 'reference/shortcuts.html',
  save: 'reference/files.html#undo-saving-and-recovery',
  picture: 'guide/looking.html#pictures-and-videos',
  video: 'guide/looking.html#pictures-and-videos',
  glb: 'guide/other-programs.html#out',
  fbx: 'guide/other-programs.html#out',
  vrma: 'guide/other-programs.html#out',
  programs: 'guide/other-programs.html#which-program-opens-what',
  about: CONTENTS,
  simplify: CLEAN_UP,
  resample: CLEAN_UP,
  bake: CLEAN_UP,
  scaleKeys: CLEAN_UP,
  convertToKeys: TAKES,
  smoothSamples: TAKES,
  resampleSamples: TAKES,
  markers: TAKES,
  loopTake: TAKES,
  lockFeet: TAKES,
  joinTakes: TAKES,
  insertTake: TAKES,
  cutOut: TAKES,
  takeSpeed: TAKES,
  checkTake: 'guide/capture-and-review.html#review',
  outsideCycle: 'guide/curves.html#cycles-and-extrapolation',
  attach: 'guide/posing.html#attach-a-character',
  retarget: 'guide/capture-and-review.html#retarget',
  holdPins: 'guide/posing.html#ik',
  skinWeights: 'guide/rigging.html#bind-a-skin',
};

const TABS: Readonly<Record<TimelineTabName, ManualPage>> = {
  curves: 'guide/curves.html#curve-editor',
  dope: 'guide/curves.html#dope-sheet',
  takes: 'guide/capture-and-review.html',
  review: 'guide/capture-and-review.html#review',
  poses: 'guide/posing.html#pose-library',
  measure: 'guide/capture-and-review.html#measure-and-compare-takes',
  steps: 'guide/looking.html#see-the-numbers',
  source: 'guide/looking.html#see-the-text',
  compare: 'guide/check-your-program.html',
};

/** The viewport's, by what dragging does there. */
const MODES: Readonly<Record<PosingMode, ManualPage>> = {
  pose: 'guide/posing.html#pose',
  fk: 'guide/posing.html#fk',
  ik: 'guide/posing.html#ik',
  rig: 'guide/rigging.html',
  select: 'guide/looking.html#move-the-camera',
};

/** Panels by `data-panel`, without the timeline's and the viewport; and the other parts of the page. */
const PARTS: Readonly<Record<string, ManualPage>> = {
  outliner: 'guide/looking.html',
  inspector: 'guide/looking.html#see-the-numbers',
  transport: 'guide/looking.html#play',
  manual: CONTENTS,
  why: 'guide/curves.html#curve-editor',
  layers: 'guide/layers.html',
};

export const MANUAL_PAGES: readonly ManualPage[] = [DIALOGS, TABS, MODES, PARTS].flatMap((pages) =>
  Object.values(pages),
);

type Shown = Uses<'dialog' | 'timeline' | 'posing' | 'manual'>;

/** @param aboutFocus the page about what has the focus, instead of the contents */
export function openManual(wb: Shown & Uses<'messages'>, aboutFocus: boolean): void {
  const page = aboutFocus ? pageAbout(wb, document.activeElement) : CONTENTS;
  if (!wb.dialog.get()) wb.manual.set({ page });
  if (!wb.dialog.get() || showManual(page)) return;
  wb.messages.note('The browser blocked the manual’s window. Allow pop-ups for this page.', 'warning');
}

/** The page about the open dialog, else about the active panel. @param target has the focus */
function pageAbout({ dialog, timeline, posing }: Shown, target: Element | null): ManualPage {
  const open = dialog.get();
  if (open) return DIALOGS[open];
  const panel = activePanel(target)?.dataset.panel ?? target?.closest(`[${REGION}]`)?.getAttribute(REGION) ?? '';
  if (panel === 'viewport') return MODES[posing.mode.get()];
  if (Object.hasOwn(PARTS, panel)) return PARTS[panel];
  const { tab } = timeline.view.get();
  return panel === 'timeline' || panel === tab ? TABS[tab] : CONTENTS;
}
