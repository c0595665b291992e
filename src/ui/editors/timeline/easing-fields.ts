/** How long a pose is eased in and out: a slider and a number for each side. */

import type { Easing } from '../../state/cycle-question.ts';
import { element, setAttribute } from '../../widgets/dom.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { shown } from '../../widgets/numbers/number-text.ts';

/** Seconds that the sliders reach; more may be typed. */
const SPAN = [0.05, 2] as const;
const STEP = 0.05;
const LEAST = 0.001;

/**
 * @param changed called with each change
 * @param refuse told why a number wasn't taken
 * @param enter called on Enter in a number's field, once the number is taken
 */
export function easingFields(
  start: Easing,
  changed: (easing: Easing) => void,
  refuse: (reason: string) => void,
  enter: () => void,
): HTMLElement {
  let easing = start;
  const row = (side: keyof Easing, label: string) => {
    const slider = element('input', { type: 'range', min: SPAN[0], max: SPAN[1], step: STEP, 'aria-label': label });
    let isRefused = false;
    const refused = (reason: string) => {
      isRefused = true;
      refuse(reason);
    };
    const field = new NumberField({
      label: `${label}, seconds`,
      text: shown,
      step: STEP,
      commit(value) {
        if (value >= LEAST) set(value);
        else refused(`${label} must be at least ${LEAST} s.`);
      },
      refuse: refused,
    });
    field.element.addEventListener('focus', () => {
      isRefused = false;
    });
    field.element.addEventListener('keydown', ({ key }) => {
      if (key === 'Enter' && !isRefused) enter();
    });
    const show = () => {
      slider.value = String(easing[side]);
      setAttribute(slider, 'aria-valuetext', `${shown(easing[side])} seconds`);
      field.show(easing[side]);
    };
    const set = (value: number) => {
      easing = { ...easing, [side]: value };
      show();
      changed(easing);
    };
    slider.addEventListener('input', () => set(Number(slider.value)));
    show();
    return element('div', { class: 'easing-row' }, element('span', {}, label), slider, field.element, 's');
  };
  return element('div', { class: 'easing-fields' }, row('easeIn', 'Ease in'), row('easeOut', 'Ease out'));
}
