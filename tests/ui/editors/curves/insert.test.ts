import { expect, it } from 'vitest';
import { insertOnCurve } from '../../../../src/ui/editors/curves/insert.ts';
import { captured, personSkeleton, takeOfRoots } from '../../../helpers/mocap.ts';
import { documentOf, workbench } from '../../builders.ts';

it('a key inserted on a sampled curve is refused in words', () => {
  const skeleton = personSkeleton();
  const { wb } = workbench(
    documentOf(
      captured(
        skeleton,
        takeOfRoots(skeleton, [
          [0, 1, 0],
          [0, 2, 0],
        ]),
      ),
    ),
  );
  const before = wb.store.document;
  insertOnCurve(wb, 1, 0.05);
  expect(wb.store.document).toBe(before);
  expect(wb.messages.list.get().map(({ text }) => text)).toEqual([
    'This curve is sampled. Convert to keys first (Keys > Samples).',
  ]);
});
