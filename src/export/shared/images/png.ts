/** PNG files from pixels (PNG specification, third edition): 8 bits a channel, with alpha only where it is used. */
import { zlibSync } from 'fflate';
import { pngFile } from '../../../formats/png/chunks.ts';
import type { Pixels } from './bmp.ts';

/** A PNG of a picture; the alpha channel is left out where it isn't used. */
export function writePng({ width, height, rgba, hasAlpha }: Pixels): Uint8Array<ArrayBuffer> {
  const channels = hasAlpha ? 4 : 3;
  const stride = 1 + channels * width;
  const rows = new Uint8Array(stride * height);
  for (let y = 0; y < height; y++) {
    // Each byte as the difference to the row above (filter 2), which compresses pictures well.
    rows[y * stride] = y > 0 ? 2 : 0;
    for (let x = 0; x < width; x++) {
      for (let k = 0; k < channels; k++) {
        const above = y > 0 ? rgba[4 * ((y - 1) * width + x) + k] : 0;
        rows[y * stride + 1 + channels * x + k] = rgba[4 * (y * width + x) + k] - above;
      }
    }
  }
  return pngFile([width, height], hasAlpha ? 'rgba' : 'rgb', [{ type: 'IDAT', data: zlibSync(rows) }]);
}
