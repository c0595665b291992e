/**
 * Blends the displayed pose towards the focused pose of the library while it is dragged, or moved by keys until Enter
 * or until the focus leaves. One undo step; Escape restores the pose. Then it is at 0 again, as nothing is blended.
 */

import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { type Blended, PoseBlend } from './pose-blend.ts';

export interface BlendTarget extends Blended {
  readonly name: string;
}

/** @param target the focused pose, if there is one */
export function blendSlider(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  target: () => BlendTarget | undefined,
): { readonly element: HTMLElement; show(): void } {
  const slider = element('input', { type: 'range', min: 0, max: 100, step: 1, value: 0 });
  const percent = element('span', { class: 'pose-percent number' });
  const label = element('label', { class: 'pose-blend' }, 'Blend', slider, percent);
  let blend: PoseBlend | undefined;
  let isHeld = false;
  /** Escape ended it, but the pointer still moves the slider. */
  let isOver = false;
  const show = () => {
    const pose = target();
    write(slider, 'disabled', pose === undefined);
    setAttribute(slider, 'aria-label', pose ? `Blend to ${pose.name}` : 'Blend');
    setTooltip(label, pose ? `Blend the current pose to ${pose.name}` : 'Blend the current pose to a saved one');
    setAttribute(slider, 'aria-valuetext', `${slider.value} percent`);
    setText(percent, `${slider.value} %`);
  };
  const finish = () => {
    blend?.commit();
    blend = undefined;
    slider.value = '0';
    show();
  };
  slider.addEventListener('input', () => {
    const pose = target();
    if (blend?.cancelled) isOver = isHeld;
    if (isOver || !pose) return finish();
    if (blend?.cancelled) blend = undefined;
    blend ??= new PoseBlend(wb, pose);
    blend.to(Number(slider.value) / 100);
    show();
  });
  slider.addEventListener('pointerdown', () => {
    isHeld = true;
    isOver = false;
  });
  const lift = () => {
    if (!isHeld) return;
    isHeld = isOver = false;
    finish();
  };
  slider.addEventListener('pointerup', lift);
  slider.addEventListener('pointercancel', lift);
  slider.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') finish();
  });
  // Escape also takes the focus away.
  slider.addEventListener('blur', () => {
    isOver = isHeld;
    finish();
  });
  show();
  return { element: label, show };
}
