/** The characters that come with the page: a list, and the files of one of them. */
import { fetchFiles } from '../io/address.ts';
import type { GivenBlob } from '../worker/protocol.ts';
import type { SampleSwitches } from './sample-display.ts';

export interface BundledExample {
  readonly id: string;
  readonly label: string;
  readonly description: string;
  /** Names beside `samples.json`. */
  readonly files: readonly string[];
  readonly shows?: SampleSwitches;
}

const FOLDER = 'samples/';

/** The samples, the opening one first. Empty where the page was published without them. */
export async function listSamples(page: string): Promise<readonly BundledExample[]> {
  const response = await fetch(new URL(`${FOLDER}samples.json`, page)).catch(() => undefined);
  if (!response?.ok) return [];
  // Our own file, made with the page and checked by its tests.
  return (await response.json()) as BundledExample[];
}

export function fetchSample(sample: BundledExample, page: string, signal?: AbortSignal): Promise<readonly GivenBlob[]> {
  const addresses = sample.files.map((name) => `${FOLDER}${name}`);
  return fetchFiles(addresses, page, signal);
}
