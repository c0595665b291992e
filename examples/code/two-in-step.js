// The second character of two-in-step.html follows the time of the first.
const [first, second] = document.querySelectorAll('marrow-viewer');

first.addEventListener('timeupdate', () => {
  const [start, end] = second.range;
  // Each take from its own beginning; a shorter one begins again.
  const since = (first.currentTime - first.range[0]) % (end - start || 1);
  second.currentTime = start + since;
});
second.addEventListener('error', ({ detail }) => console.error(detail.message));
