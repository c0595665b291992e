import { expect, it } from 'vitest';
import { dofEntries } from '../../../../src/ui/editors/inspector/dof-menu.ts';
import { captured, figure, take } from '../../../helpers/mocap.ts';
import { documentOf, workbench } from '../../builders.ts';

it('a key on a sampled curve is refused in words by the menu of its value', () => {
  const skeleton = figure();
  const rows = [0, 1].map((z) => [0, 1, z] as const);
  const { wb } = workbench(documentOf(captured(skeleton, take(skeleton, rows))));
  const before = wb.store.document;
  const entries = dofEntries(wb, before.characters[0], [4], () => {});
  for (const entry of entries) if (entry.kind === 'item' && entry.label === 'Key at current time') entry.run();
  expect(wb.store.document).toBe(before);
  expect(wb.messages.list.get().map(({ text }) => text)).toEqual([
    'This curve is sampled. Convert to keys first: Keys > Samples.',
  ]);
});
