/**
 * The page's Content-Security-Policy, put into its HTML by the build, and the headers that hosts should send besides
 * (docs/hosting.md; the tests' server sends them too).
 *
 * Nothing comes from elsewhere but files that the address names (`?files=`), which may be anywhere. No script is inline
 * or made of text; WebAssembly is, by the decoders of Draco and meshoptimizer, which are part of the page. Styles are
 * files; those of single elements are set by script, which no policy forbids. Scripts for workers pass the check of
 * src/io/trusted-scripts.ts.
 */
import type { Plugin } from 'vite';

const RULES: Readonly<Record<string, string>> = {
  'default-src': "'none'",
  'script-src': "'self' 'wasm-unsafe-eval'",
  'style-src': "'self'",
  'img-src': "'self' blob:",
  'connect-src': "'self' http: https:",
  'worker-src': "'self'",
  'manifest-src': "'self'",
  'base-uri': "'none'",
  'form-action': "'none'",
  'require-trusted-types-for': "'script'",
  'trusted-types': 'default',
};

/** What the development server needs: it puts styles into the page, and reloads by a socket. */
const DEVELOPING: Readonly<Record<string, string>> = {
  ...Object.fromEntries(Object.entries(RULES).filter(([name]) => !name.includes('trusted-types'))),
  'style-src': "'self' 'unsafe-inline'",
  'connect-src': '*',
};

const text = (rules: Readonly<Record<string, string>>) =>
  Object.entries(rules)
    .map(([name, value]) => `${name} ${value}`)
    .join('; ');

export const POLICY = text(RULES);

/** Pages don't accept `frame-ancestors` in HTML, so only hosts can keep others from framing it. */
export const HEADERS: Readonly<Record<string, string>> = {
  'Content-Security-Policy': `${POLICY}; frame-ancestors 'none'`,
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Permissions-Policy': 'camera=(), geolocation=(), microphone=(), payment=(), usb=()',
  'Referrer-Policy': 'no-referrer',
  'X-Content-Type-Options': 'nosniff',
};

export function policy(): Plugin {
  return {
    name: 'marrow-policy',
    transformIndexHtml: (_html, { server }) => [
      {
        tag: 'meta',
        attrs: { 'http-equiv': 'Content-Security-Policy', content: server ? text(DEVELOPING) : POLICY },
        // Before anything that it is about.
        injectTo: 'head-prepend',
      },
    ],
  };
}
