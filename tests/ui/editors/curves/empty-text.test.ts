import { expect, it } from 'vitest';
import { emptyPlotText } from '../../../../src/ui/editors/curves/empty-text.ts';
import { listedChannels } from '../../../../src/ui/editors/timeline/channels.ts';
import { character, documentOf, skin } from '../../../helpers/builders.ts';
import { workbench } from '../../builders.ts';

it('a skin alone lists no channels, and its plot asks for a skeleton instead of joints to rotate', () => {
  const { skeleton: _, ...alone } = character({ name: 'head', skins: [skin('head')], clips: [], shownClip: -1 });
  const { wb } = workbench(documentOf(alone));
  expect(listedChannels(alone, {}, { list: 'all', pinned: [], filter: '' })).toEqual([]);
  expect(emptyPlotText(wb, 0)).toBe('head has no skeleton, so there is nothing to animate. Drop its .skel file here.');
});
