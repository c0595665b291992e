/** Once for each run of the browser tests: where there is no Firefox, its tests are no part of the run. */
import { firefoxPath } from './firefox-path.ts';

export default function tellFirefox(): void {
  if (!firefoxPath()) console.log('Firefox not found: its tests are no part of this run (set MARROW_FIREFOX).');
}
