/** Controls of the poses tab, beside the tabs: saving a pose, and how poses are applied. */

import { button, element, keepsFocusElsewhere, setText } from '../../kit/dom.ts';
import { oncePerFrame } from '../../kit/frame.ts';
import type { Observable } from '../../kit/observable.ts';
import { toolbar } from '../../kit/roving.ts';
import { findAction, isEnabled, tryAction } from '../../state/action.ts';
import { setActionTooltip } from '../../state/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';

/** How a click applies a pose. */
export interface PoseOptions {
  /** 1: all of it. */
  readonly share: number;
  /** Only the selected joint and its descendants. */
  readonly branch: boolean;
}

const BUTTONS: readonly (readonly [id: string, text: string, label: string])[] = [
  ['pose.keep', 'Save pose', 'Save current pose to library'],
  ['pose.copy', 'Copy', 'Copy current pose'],
  ['pose.paste', 'Paste', 'Paste copied pose'],
  ['pose.mirror', 'Mirror', 'Mirror current pose'],
];

export function poseTools(
  wb: Uses<'store' | 'actions' | 'posing' | 'settings'>,
  options: Observable<PoseOptions>,
): HTMLElement {
  const refreshing: (() => void)[] = [];
  const buttons = BUTTONS.map(([id, text, label]) => {
    const action = findAction(wb, id);
    const made = keepsFocusElsewhere(
      button(text, { class: 'tool text-tool' }, text, () => action && tryAction(wb, action)),
    );
    setActionTooltip(wb, made, id, label);
    refreshing.push(() => {
      made.disabled = !(action && isEnabled(wb, action));
    });
    return made;
  });
  const slider = element('input', {
    type: 'range',
    min: 0,
    max: 100,
    step: 1,
    'aria-label': 'Blend amount of an applied pose',
  });
  const percent = element('span', { class: 'pose-percent number' });
  slider.addEventListener('input', () => options.update((now) => ({ ...now, share: Number(slider.value) / 100 })));
  slider.addEventListener('dblclick', () => options.update((now) => ({ ...now, share: 1 })));
  const share = element(
    'label',
    { class: 'pose-blend', tooltip: 'Blend amount of an applied pose' },
    'Blend',
    slider,
    percent,
  );
  const branch = keepsFocusElsewhere(
    button(
      'Hierarchy only',
      {
        class: 'tool text-tool',
        'aria-pressed': 'false',
        tooltip: 'Apply only to the selected joint and its descendants',
      },
      'Hierarchy only',
      () => options.update((now) => ({ ...now, branch: !now.branch })),
    ),
  );
  const show = () => {
    const { share: part, branch: isBranch } = options.get();
    slider.value = String(Math.round(100 * part));
    slider.setAttribute('aria-valuetext', `${slider.value} percent`);
    setText(percent, `${slider.value} %`);
    branch.setAttribute('aria-pressed', String(isBranch));
    for (const refresh of refreshing) refresh();
  };
  wb.store.subscribe(oncePerFrame(show));
  wb.posing.copied.subscribe(show);
  options.subscribe(show);
  show();
  return element(
    'div',
    { class: 'pose-tools' },
    toolbar(element('div', { class: 'tools', 'aria-label': 'Poses' }, ...buttons)),
    element(
      'div',
      { class: 'pose-cards', role: 'group', 'aria-label': 'How a pose is applied' },
      element('span', { class: 'faint', 'aria-hidden': 'true' }, 'Cards'),
      branch,
      share,
    ),
  );
}
