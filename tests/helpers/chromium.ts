/**
 * Finds a Chromium for the browser tests, in this order:
 *
 *     MARROW_CHROMIUM, then CHROME_PATH     an explicit choice: used or refused, never skipped
 *     an installed Chrome, Chromium or Edge  by its usual path or on PATH
 *     Playwright's own                       where `npx playwright install chromium` puts it
 *     the one in @sparticuz/chromium         Linux x64 only; unpacked once into node_modules/.cache
 *
 * The last makes `npm ci && npm test` work with only Node and git. The package is made for AWS Lambda: it unpacks to
 * fixed names in the temporary folder, and brings the shared libraries (NSS, NSPR, expat) along only where it sees
 * Lambda's environment variable. So unpacking runs in a process of its own, with that variable and our own temporary
 * folder: nothing half-unpacked or foreign is ever run. The libraries are used only if the browser doesn't start with
 * the system's.
 */
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { delimiter, dirname, join } from 'node:path';
import { env, platform } from 'node:process';
import { fileURLToPath } from 'node:url';
import { type Browser, chromium } from 'playwright-core';

/** An executable, and environment variables it needs. */
export interface FoundChromium {
  readonly path: string;
  readonly env: Readonly<Record<string, string>>;
  /** Its source, for messages. */
  readonly from: string;
}

/** Software rendering, the same on every machine. */
const IN_SOFTWARE: readonly string[] = [
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--ignore-gpu-blocklist',
  // Only WebGL is drawn by SwiftShader; for the page itself the browser's own software renderer is faster.
  '--disable-gpu-compositing',
];

/** No sandbox, for root in containers; and no requests by the browser itself, so that a test only sees the page's. */
const ALWAYS: readonly string[] = [
  '--no-sandbox',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--no-first-run',
];

/** Those of tests. */
export const CHROMIUM_FLAGS: readonly string[] = [...ALWAYS, ...IN_SOFTWARE];

const NOT_FOUND =
  'No Chromium found: install Chrome or Chromium, run "npx playwright install chromium", ' +
  'or set MARROW_CHROMIUM to the path of one.';

let found: FoundChromium | undefined;

/** @throws Error of one line if there is none */
export function findChromium(): FoundChromium {
  found ??= asked() ?? installed() ?? playwrights() ?? packaged();
  if (!found) {
    console.error(NOT_FOUND);
    throw new Error(NOT_FOUND);
  }
  return found;
}

export interface LaunchOptions {
  /** In a window. */
  readonly headed?: boolean;
  /** False: by whatever the browser finds, with the flags given. */
  readonly inSoftware?: boolean;
}

/** Launches the browser found by `findChromium`. */
export function launchChromium(
  extraFlags: readonly string[] = [],
  { headed = false, inSoftware = true }: LaunchOptions = {},
): Promise<Browser> {
  const { path, env: extra } = findChromium();
  const environment = Object.fromEntries(
    Object.entries({ ...env, ...extra }).flatMap(([name, value]) => (value === undefined ? [] : [[name, value]])),
  );
  const args = [...(inSoftware ? CHROMIUM_FLAGS : ALWAYS), ...extraFlags];
  return chromium.launch({ executablePath: path, env: environment, headless: !headed, args });
}

function asked(): FoundChromium | undefined {
  for (const name of ['MARROW_CHROMIUM', 'CHROME_PATH']) {
    const path = env[name];
    if (!path) continue;
    if (!existsSync(path)) throw new Error(`${name} is "${path}", but there is no such file.`);
    return { path, env: {}, from: name };
  }
  return undefined;
}

function installed(): FoundChromium | undefined {
  const path = usualPaths().find((candidate) => existsSync(candidate) && starts(candidate, {}));
  return path === undefined ? undefined : { path, env: {}, from: 'installed' };
}

function usualPaths(): string[] {
  if (platform === 'darwin') {
    return ['Google Chrome', 'Chromium', 'Microsoft Edge'].flatMap((app) =>
      ['', env.HOME ?? ''].map((home) => `${home}/Applications/${app}.app/Contents/MacOS/${app}`),
    );
  }
  if (platform === 'win32') {
    const roots = [env.PROGRAMFILES, env['PROGRAMFILES(X86)'], env.LOCALAPPDATA].filter((root) => root !== undefined);
    return ['Google\\Chrome\\Application\\chrome.exe', 'Chromium\\Application\\chrome.exe'].flatMap((end) =>
      roots.map((root) => join(root, end)),
    );
  }
  const names = ['google-chrome-stable', 'google-chrome', 'chromium', 'chromium-browser', 'microsoft-edge-stable'];
  const folders = [...(env.PATH ?? '').split(delimiter), '/usr/bin', '/usr/local/bin', '/snap/bin'];
  return [
    ...names.flatMap((name) => folders.map((folder) => join(folder, name))),
    '/opt/google/chrome/chrome',
    '/usr/lib/chromium/chromium',
  ];
}

function playwrights(): FoundChromium | undefined {
  const path = chromium.executablePath();
  return path && existsSync(path) && starts(path, {}) ? { path, env: {}, from: "Playwright's" } : undefined;
}

function packaged(): FoundChromium | undefined {
  if (platform !== 'linux' || process.arch !== 'x64') return undefined;
  const folder = unpacked();
  const path = join(folder, 'chromium');
  const fonts: Record<string, string> = existsSync('/etc/fonts/fonts.conf')
    ? {}
    : { FONTCONFIG_FILE: join(folder, 'fonts.conf') };
  // Prefers the system's libraries if complete: they are newer and match their own dependencies.
  const all: readonly Record<string, string>[] = [{}, { LD_LIBRARY_PATH: join(folder, 'al2023', 'lib') }];
  for (const libraries of all) {
    const extra: Record<string, string> = { ...fonts, ...libraries };
    if (starts(path, extra)) return { path, env: extra, from: '@sparticuz/chromium' };
  }
  return undefined;
}

/**
 * Whether it is a browser that starts: neither a stub that tells how to install one, nor one with missing libraries.
 * (On Windows asking for the version opens a window, so there the file's existence suffices.)
 */
function starts(path: string, extra: Readonly<Record<string, string>>): boolean {
  if (platform === 'win32') return true;
  const { status } = spawnSync(path, ['--version'], { env: { ...env, ...extra }, stdio: 'ignore', timeout: 20_000 });
  return status === 0;
}

/** The folder of the package's browser, unpacked if necessary. @throws Error with the cause */
function unpacked(): string {
  const root = fileURLToPath(new URL('../../', import.meta.url));
  const entry = createRequire(import.meta.url).resolve('@sparticuz/chromium');
  const { version } = JSON.parse(readFileSync(join(dirname(entry), '..', '..', 'package.json'), 'utf8'));
  const cache = join(root, 'node_modules', '.cache');
  const folder = join(cache, `chromium-${version}`);
  if (existsSync(folder)) return folder;

  mkdirSync(cache, { recursive: true });
  const scratch = mkdtempSync(join(cache, 'unpacking-'));
  try {
    const unpack = "(await import('@sparticuz/chromium')).default.executablePath()";
    const { status, stderr } = spawnSync(process.execPath, ['--input-type=module', '-e', `await ${unpack}`], {
      cwd: root,
      env: { ...env, TMPDIR: scratch, AWS_EXECUTION_ENV: 'AWS_Lambda_nodejs20.x' },
      encoding: 'utf8',
    });
    if (status !== 0) throw new Error(`Could not unpack @sparticuz/chromium: ${stderr}`);
    writeFileSync(join(scratch, 'fonts.conf'), fontsConfig(folder));
    renameSync(scratch, folder);
  } catch (error) {
    // Another test process may have been first; its folder is complete, since it was renamed into place.
    if (!existsSync(folder)) throw error;
  } finally {
    rmSync(scratch, { recursive: true, force: true });
  }
  return folder;
}

/** For a machine without fonts: the package's, whose own configuration names Lambda's folders. */
function fontsConfig(folder: string): string {
  return `<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig><dir>${folder}/fonts</dir><cachedir>${folder}/fonts-cache</cachedir></fontconfig>
`;
}
