/** The documents of a page as bytes. */
import { unzipSync } from 'fflate';
import type { Page } from 'playwright-core';

/** Content by name: a file of each kind that a character is saved in, and what it consists of. */
export type Files = Readonly<Record<string, string>>;

/** Files of all characters. Bytes are Latin-1. */
export async function filesOf(page: Page): Promise<Files> {
  const { base64, characters } = await page.evaluate(async () => {
    const zip = await window.marrow.zip();
    const url: string = await new Promise((resolve, reject) => {
      const reader = new FileReader();
      // A data URL is text.
      reader.onload = () => resolve(reader.result as string);
      reader.onerror = () => reject(reader.error);
      reader.readAsDataURL(zip);
    });
    const told = window.marrow.characters().map(({ dofs: _shown, ...character }) => character);
    return { base64: url.slice(url.indexOf(',') + 1), characters: JSON.stringify(told) };
  });
  const files = Object.entries(unzipSync(new Uint8Array(Buffer.from(base64, 'base64'))));
  return {
    ...Object.fromEntries(files.map(([name, bytes]) => [name, Buffer.from(bytes).toString('latin1')])),
    characters,
  };
}

/** Where two differ first, in words; undefined if nowhere. */
export function differenceOf(before: Files, after: Files): string | undefined {
  for (const name of new Set([...Object.keys(before), ...Object.keys(after)])) {
    const [was, now] = [before[name], after[name]];
    if (was === now) continue;
    if (was === undefined) return `${name} is new`;
    if (now === undefined) return `${name} is gone`;
    let at = 0;
    while (was[at] === now[at]) at++;
    const around = (text: string) => JSON.stringify(text.slice(Math.max(0, at - 40), at + 40));
    return `${name} differs from byte ${at}: ${around(was)} became ${around(now)}`;
  }
  return undefined;
}
