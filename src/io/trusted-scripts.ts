declare global {
  interface Window {
    /** Missing in the compiler's library, and in some browsers. */
    readonly trustedTypes?: {
      createPolicy(name: string, rules: { createScriptURL(address: string): string | null }): unknown;
    };
  }
}

/**
 * What the page may start as a worker: its own files. With `require-trusted-types-for 'script'` browsers ask the policy
 * named `default` about each address, and run none that it refuses; text is never run at all.
 */
export function trustOwnScripts(): void {
  const own = new URL('.', document.baseURI).href;
  window.trustedTypes?.createPolicy('default', {
    createScriptURL: (address) => (new URL(address, document.baseURI).href.startsWith(own) ? address : null),
  });
}
