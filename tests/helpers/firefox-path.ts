/** Where Firefox is: `MARROW_FIREFOX`, or else an installed one, by its usual path or on PATH. */
import { existsSync } from 'node:fs';
import { delimiter, join } from 'node:path';
import { env, platform } from 'node:process';

/** Undefined if there is none. @throws Error if MARROW_FIREFOX names none */
export function firefoxPath(): string | undefined {
  const asked = env.MARROW_FIREFOX;
  if (asked && !existsSync(asked)) throw new Error(`MARROW_FIREFOX is "${asked}", but there is no such file.`);
  return asked || usualPaths().find((candidate) => existsSync(candidate));
}

function usualPaths(): string[] {
  if (platform === 'darwin') {
    return ['', env.HOME ?? ''].map((home) => `${home}/Applications/Firefox.app/Contents/MacOS/firefox`);
  }
  if (platform === 'win32') {
    const roots = [env.PROGRAMFILES, env['PROGRAMFILES(X86)'], env.LOCALAPPDATA].filter((root) => root !== undefined);
    return roots.map((root) => join(root, 'Mozilla Firefox', 'firefox.exe'));
  }
  const folders = [...(env.PATH ?? '').split(delimiter), '/usr/bin', '/usr/local/bin', '/snap/bin', '/opt/firefox'];
  return ['firefox-esr', 'firefox'].flatMap((name) => folders.map((folder) => join(folder, name)));
}
