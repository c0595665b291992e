import { describe, expect, it } from 'vitest';
import type { Character } from '../../../../src/model/document.ts';
import { followForm } from '../../../../src/ui/editors/posing/mode-of-form.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

const bones = skeleton(['root', -1], ['arm', 0]);
const usual = character({ id: 'usual', skeleton: bones });
const axes = character({ id: 'axes', skeleton: { ...bones, form: 'axis-angle' } });

function page() {
  const { wb } = workbench();
  followForm(wb);
  const open = (...characters: Character[]) => {
    wb.store.replace('Open', documentOf(...characters));
    return wb.posing.mode.get();
  };
  return { wb, open };
}

describe('the mode that characters open in', () => {
  it('is Pose, for the axis-angle form FK, and Pose again for the next', () => {
    const { open } = page();
    expect([open(usual), open(usual, axes), open(usual, axes, { ...usual, id: 'next' })]).toEqual([
      'pose',
      'fk',
      'pose',
    ]);
  });

  it('is the one that was chosen', () => {
    const { wb, open } = page();
    wb.posing.mode.set('fk');
    expect(open(usual)).toBe('fk');
    wb.posing.mode.set('ik');
    expect(open(usual, axes)).toBe('ik');
  });
});
