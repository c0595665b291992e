import { expect, it, vi } from 'vitest';
import { dofEntries } from '../../../../src/ui/editors/inspector/dof-menu.ts';
import { captured, personSkeleton, takeOfRoots } from '../../../helpers/mocap.ts';
import { documentOf, workbench } from '../../builders.ts';

it('a key on a sampled curve is offered with converting it by the menu of its value', async () => {
  const skeleton = personSkeleton();
  const rows = [0, 1].map((z) => [0, 1, z] as const);
  const { wb } = workbench(documentOf(captured(skeleton, takeOfRoots(skeleton, rows))));
  const before = wb.store.document;
  const entries = dofEntries(wb, before.characters[0], [4], () => {});
  for (const entry of entries) if (entry.kind === 'item' && entry.label === 'Key at current time') entry.run();
  expect(wb.store.document).toBe(before);
  await vi.waitUntil(() => wb.messages.offers[0], { interval: 1, timeout: 20_000 });
  expect(wb.messages.passing.get()).toContain('at every frame, and no single keys');
  expect(wb.messages.offers[0]?.label).toBe('Convert to keys and key');
});
