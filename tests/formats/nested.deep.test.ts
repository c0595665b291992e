import { expect, it } from 'vitest';
import { readSkel } from '../../src/formats/skel/read.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { expectLinearTime } from '../helpers/growth.ts';

const skel = (text: string) => readSkel(text, 'hero.skel');

// Deeper than any stack of calls.
it('reads and writes 20,000 nested joints in a time that grows with their number, and tells of one not closed', () => {
  expectLinearTime((n) => {
    const { value } = skel('balljoint x{'.repeat(n) + '}'.repeat(n));
    expect(value?.[0].joints).toHaveLength(n);
    expect(value?.[0].joints[n - 1].parent).toBe(n - 2);
    expect(skel('balljoint x{'.repeat(n) + '}'.repeat(n - 1)).diagnostics).toMatchObject([{ code: 'brace-missing' }]);
    const again = readSkel(writeSkel(value ?? []).text, 'hero.skel');
    expect(again.value?.[0].joints).toHaveLength(n);
  }, 5_000);
});
