/** Controls of the poses tab, beside the tabs: saving a pose, and how poses are applied. */

import { currentCharacter, findAction, isEnabled, tryAction } from '../../state/actions/action.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, write } from '../../widgets/dom.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import type { Observable } from '../../widgets/observable.ts';
import { focusedPose } from './actions.ts';
import { blendSlider } from './blend-slider.ts';
import { hierarchiesMeant } from './hierarchies.ts';

/** How poses are applied and blended. */
export interface PoseOptions {
  /** Only the selected joints and their descendants. */
  readonly branch: boolean;
}

const BUTTONS: readonly (readonly [id: string, text: string, label: string])[] = [
  ['pose.keep', 'Save pose', 'Save current pose to library'],
  ['pose.copy', 'Copy', 'Copy current pose'],
  ['pose.paste', 'Paste', 'Paste copied pose'],
  ['pose.mirror', 'Mirror', 'Mirror current pose'],
];

export function poseTools(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
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
      write(made, 'disabled', !(action && isEnabled(wb, action)));
    });
    return made;
  });
  const blend = blendSlider(wb, () => {
    const character = currentCharacter(wb);
    const pose = focusedPose(wb);
    if (!character || !pose) return undefined;
    const joints = hierarchiesMeant(wb, character, options.get().branch);
    return { characterId: character.id, pose: wb.posing.libraryPose.get(), joints, name: pose.name };
  });
  const branch = keepsFocusElsewhere(
    button(
      'Hierarchy only',
      {
        class: 'tool text-tool',
        'aria-pressed': 'false',
        tooltip: 'Apply only to the selected joints and their descendants',
      },
      'Hierarchy only',
      () => options.update((now) => ({ ...now, branch: !now.branch })),
    ),
  );
  const show = () => {
    const { branch: isBranch } = options.get();
    blend.show();
    setAttribute(branch, 'aria-pressed', String(isBranch));
    for (const refresh of refreshing) refresh();
  };
  wb.store.subscribe(oncePerFrame(show));
  wb.posing.copied.subscribe(show);
  wb.posing.libraryPose.subscribe(show);
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
      blend.element,
    ),
  );
}
