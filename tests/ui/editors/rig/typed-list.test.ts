import { describe, expect, it } from 'vitest';
import { COMPOUND_DOFS } from '../../../../src/model/skeleton/skeleton.ts';
import { typedList } from '../../../../src/ui/editors/rig/typed-list.ts';

describe('the DOFs of a compound joint, typed', () => {
  it('typed DOFs of a compound joint are taken in their order, whatever is between them', () => {
    expect(typedList(' Ty, rx  sz ', COMPOUND_DOFS)).toEqual(['ty', 'rx', 'sz']);
  });

  it.each([
    ['', 'at least one'],
    ['rx rx', 'twice'],
    ['rx qw', 'not one of'],
  ])('“%s” is refused', (text, why) => expect(typedList(text, COMPOUND_DOFS)).toContain(why));
});
