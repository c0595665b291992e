import { expect, it } from 'vitest';
import { emptyPlotText } from '../../../../src/ui/editors/curves/empty-text.ts';
import { listedChannels } from '../../../../src/ui/editors/timeline/channels.ts';
import { character, documentOf, skin, takeOfValues } from '../../../helpers/builders.ts';
import { workbench } from '../../builders.ts';

it('a skin alone lists no channels, and its plot asks for a skeleton instead of joints to rotate', () => {
  const { skeleton: _, ...alone } = character({ name: 'head', skins: [skin('head')], takes: [], shownTake: -1 });
  const { wb } = workbench(documentOf(alone));
  expect(listedChannels(alone, {}, { list: 'all', pinned: [], filter: '' })).toEqual([]);
  expect(emptyPlotText(wb, 0)).toBe('head has no skeleton, so there is nothing to animate. Drop its .skel file here.');
});

it('a take without keys is named, as it is listed and has a length', () => {
  const still = character({ name: 'green', takes: [takeOfValues('pose', [])], shownTake: 0 });
  const { wb } = workbench(documentOf(still));
  expect(emptyPlotText(wb, 0)).toMatch(/^The take pose has no keys\. Rotate a joint and press K to key it at 0 s /);
  const { wb: without } = workbench(documentOf(character({ name: 'green', takes: [], shownTake: -1 })));
  expect(emptyPlotText(without, 0)).toMatch(/^green has no animation\. /);
});
