/** The examples that come with the page: their list, and the files of one. */
import { fetchFiles } from '../io/address.ts';
import type { GivenBlob } from '../worker/protocol.ts';
import type { SampleSwitches } from './example-display.ts';

export interface BundledExample {
  readonly id: string;
  readonly label: string;
  readonly description: string;
  /** Names next to `samples.json`. */
  readonly files: readonly string[];
  readonly shows?: SampleSwitches;
}

const FOLDER = 'samples/';

/** The examples, the opening one first. Empty if the page was published without them. */
export async function listSamples(page: string): Promise<readonly BundledExample[]> {
  const response = await fetch(new URL(`${FOLDER}samples.json`, page)).catch(() => undefined);
  if (!response?.ok) return [];
  // Generated at build time and checked by tests.
  return (await response.json()) as BundledExample[];
}

export function fetchSample(sample: BundledExample, page: string, signal?: AbortSignal): Promise<readonly GivenBlob[]> {
  const addresses = sample.files.map((name) => `${FOLDER}${name}`);
  return fetchFiles(addresses, page, signal);
}
