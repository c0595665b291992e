import { expect, it } from 'vitest';
import { DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import { heightsText, unitsApart } from '../../../src/ui/shell/heights-note.ts';
import { character, joint } from '../../helpers/builders.ts';

const NO_BOX = { min: [0, 0, 0], max: [0, 0, 0] } as const;
const tall = (height: number) =>
  character({
    skeleton: { name: '', joints: [joint(-1, { box: NO_BOX }), joint(0, { offset: [0, height, 0], box: NO_BOX })] },
  });

it('the same height is offered for characters of which one is more than four times as tall', () => {
  expect(heightsText([tall(0.02), tall(2), tall(60)])).toEqual(['The characters are 0.02 to 60 units tall.']);
  expect(heightsText([tall(1), tall(4)])).toBeUndefined();
  expect(heightsText([tall(60)])).toBeUndefined();
  expect(heightsText([])).toBeUndefined();
});

it('the same unit is offered if a power of ten is about all that heights differ by', () => {
  expect(heightsText([tall(1.8), tall(165)])).toEqual([
    'The characters are 1.8 to 170 units tall.',
    'Some may be in metres, others in centimetres.',
  ]);
  expect(unitsApart([tall(1.8), tall(165)])).toBe(100);
  expect(unitsApart([tall(0.02), tall(60)])).toBeUndefined();
  expect(unitsApart([tall(1), tall(1.5)])).toBeUndefined();
  expect(unitsApart([])).toBeUndefined();
});

it('the same height is not offered for characters that are scaled to it', () => {
  const scaled = { ...tall(60), placements: [{ ...DEFAULT_PLACEMENT, scale: 1 / 30 }] };
  expect(heightsText([tall(2), scaled])).toBeUndefined();
});
