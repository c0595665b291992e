/** Splitters between panels: dragged, or moved with the arrow keys; sizes are remembered. */
import { element, setAttribute } from '../../widgets/dom.ts';
import { followPointer } from '../../widgets/drag.ts';
import type { Panels } from '../settings.ts';
import type { Uses } from '../workbench.ts';

type Size = 'outlinerWidth' | 'inspectorWidth' | 'filesHeight' | 'timelineHeight' | 'dopeHeight';

const LIMITS: Readonly<Record<Size, { readonly min: number; readonly max: number }>> = {
  outlinerWidth: { min: 180, max: 560 },
  inspectorWidth: { min: 240, max: 640 },
  filesHeight: { min: 64, max: 640 },
  timelineHeight: { min: 120, max: 900 },
  dopeHeight: { min: 40, max: 800 },
};

/** Whether the panel grows when the splitter moves right or down. */
const GROWS: Readonly<Record<Size, 1 | -1>> = {
  outlinerWidth: 1,
  inspectorWidth: -1,
  filesHeight: -1,
  timelineHeight: -1,
  dopeHeight: 1,
};
const KEY_STEP = 16;

/** What a splitter for a height sizes: files and messages follow theirs, the timeline contains its own. */
const SIZED: Readonly<Partial<Record<Size, (edge: HTMLElement) => Element | null>>> = {
  filesHeight: (edge) => edge.nextElementSibling,
  timelineHeight: (edge) => edge.parentElement,
  dopeHeight: (edge) => edge.previousElementSibling,
};

export function clampSize(size: Size, value: number): number {
  return Math.round(Math.min(LIMITS[size].max, Math.max(LIMITS[size].min, value)));
}

export function splitter(wb: Uses<'settings'>, size: Size, label: string): HTMLElement {
  const vertical = !size.endsWith('Height');
  const edge = element('div', {
    role: 'separator',
    class: `splitter splitter-${size}`,
    tabindex: 0,
    'aria-label': label,
    'aria-orientation': vertical ? 'vertical' : 'horizontal',
    'aria-valuemin': LIMITS[size].min,
    'aria-valuemax': LIMITS[size].max,
  });
  const set = (value: number) => {
    const change: Partial<Panels> = { [size]: clampSize(size, value) };
    wb.settings.update((s) => ({ ...s, panels: { ...s.panels, ...change } }));
  };
  const chosen = () => clampSize(size, wb.settings.get().panels[size]);
  // A default size, or one that doesn't fit, starts from the displayed size.
  const sizeNow = () => {
    const sized = SIZED[size]?.(edge);
    return (sized instanceof HTMLElement && sized.offsetHeight) || chosen();
  };
  const show = () => {
    setAttribute(edge, 'aria-valuenow', String(wb.settings.get().panels[size] ? chosen() : sizeNow()));
  };
  wb.settings.subscribe(show);
  edge.addEventListener('focus', show);
  show();

  edge.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    event.preventDefault();
    const from = vertical ? event.clientX : event.clientY;
    const base = sizeNow();
    edge.classList.add('dragging');
    followPointer(edge, event, {
      move: (e) => set(base + GROWS[size] * ((vertical ? e.clientX : e.clientY) - from)),
      over: () => edge.classList.remove('dragging'),
    });
  });
  edge.addEventListener('keydown', (event) => {
    const steps: Record<string, number> = vertical ? { ArrowLeft: -1, ArrowRight: 1 } : { ArrowUp: -1, ArrowDown: 1 };
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    set(sizeNow() + GROWS[size] * step * KEY_STEP);
  });
  return edge;
}
