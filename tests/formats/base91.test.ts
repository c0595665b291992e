import fc from 'fast-check';
import { expect, it } from 'vitest';
import { fromBase91, toBase91 } from '../../src/formats/base91.ts';

it('bytes come back from text that is no markup, in lines or not, and take less room than in base 64', () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 2000 }), (bytes) => {
      const text = toBase91(bytes);
      expect(text).toMatch(/^[!#-%'-;=-~]*$/);
      expect(fromBase91(text)).toEqual(bytes);
      expect(fromBase91(`\n${text.replace(/.{7}/g, '$&\n ')}`)).toEqual(bytes);
      expect(text.length).toBeLessThanOrEqual(Math.ceil((bytes.length * 16) / 13) + 1);
    }),
  );
});
