/** Maps the lines of a text file to the parts of the model, for any format. */
import type { SourceMap } from '../../model/source-map.ts';
import { amcLocator, asfLocator } from './acclaim.ts';
import { animLocator } from './anim.ts';
import { bvhLocator } from './bvh.ts';
import type { Located, Locator } from './locator.ts';
import { SourceScanner } from './scanner.ts';
import { skelLocator } from './skel.ts';
import { morphLocator, skinLocator } from './skin.ts';

/** By extension. Of other files only the lines are known. */
const LOCATORS: ReadonlyMap<string, (found: Located) => Locator> = new Map([
  ['skel', skelLocator],
  ['axskel', skelLocator],
  ['skin', skinLocator],
  ['morph', morphLocator],
  ['anim', animLocator],
  ['bvh', bvhLocator],
  ['asf', asfLocator],
  ['amc', amcLocator],
]);

/** Takes a file in pieces. */
export class SourceMapper {
  private readonly found: Located = { marks: [], rows: [] };
  private readonly scanner: SourceScanner;

  constructor(fileName: string) {
    const extension = fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase();
    this.scanner = new SourceScanner(LOCATORS.get(extension)?.(this.found));
  }

  /** Takes the next bytes of the file, which may be split anywhere. */
  feed(bytes: Uint8Array): void {
    this.scanner.feed(bytes);
  }

  /** The map of the file; nothing may be fed after it. */
  finish(): SourceMap {
    return { index: this.scanner.finish(), ...this.found };
  }
}

/** Maps a whole file. */
export function mapSource(bytes: Uint8Array, fileName: string): SourceMap {
  const mapper = new SourceMapper(fileName);
  mapper.feed(bytes);
  return mapper.finish();
}
