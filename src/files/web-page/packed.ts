/** Bytes in HTML. */
import { deflateSync } from 'fflate';
import { toBase91 } from '../../formats/base91.ts';

/** Bytes, deflated, as text that HTML leaves as it is: `viewer/saved/unpack.ts` is the way back. */
export function packedText(bytes: Uint8Array): string {
  return toBase91(deflateSync(bytes, { level: 9 }));
}
