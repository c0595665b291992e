/** Kept sizes of the panels and which are collapsed, as the stylesheet wants them. */
import { isPanelOpen, type PanelName } from '../state/panels/panels.ts';
import { clampSize } from '../state/panels/splitter.ts';
import type { Settings } from '../state/settings.ts';

const WIDTHS = [
  ['outlinerWidth', '--outliner-width'],
  ['inspectorWidth', '--inspector-width'],
] as const;
/** 0 until chosen: the stylesheet's own. */
const HEIGHTS = [
  ['filesHeight', '--files-height'],
  ['timelineHeight', '--timeline-height'],
  ['dopeHeight', '--dope-height'],
] as const;
const PANELS: readonly PanelName[] = ['outliner', 'inspector', 'timeline'];

/** Sizes the page's panels, or those of its frame, so that the first picture is as large as it stays. */
export function sizePanels(root: HTMLElement, settings: Settings): void {
  const { panels } = settings;
  for (const [size, property] of [...WIDTHS, ...HEIGHTS]) {
    if (panels[size]) root.style.setProperty(property, `${clampSize(size, panels[size])}px`);
    else root.style.removeProperty(property);
  }
  for (const name of PANELS) root.classList.toggle(`${name}-folded`, !isPanelOpen(settings, name));
}
