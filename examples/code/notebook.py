# A take in the cell of a notebook: show('walker.skel', 'walker.skin', 'walker_walk.anim')
import html
import json
import pathlib

from IPython.display import HTML

# Where you have put build/package/element/; other hosts must allow it (CORS).
VIEWER = 'https://example.edu/marrow/marrow-viewer.js'


def show(*paths, attributes='autoplay loop controls', width=640, height=480):
    """Text files as they are now, in a frame that holds all of them."""
    files = [{'name': path.name, 'content': path.read_text()} for path in map(pathlib.Path, paths)]
    # Nothing in a file ends the script.
    data = json.dumps(files).replace('<', '\\u003c')
    page = f'''<script type="module" src="{VIEWER}"></script>
<marrow-viewer {attributes}></marrow-viewer>
<script type="module">document.querySelector('marrow-viewer').showFiles({data})</script>'''
    style = f'width: {width}px; height: {height}px; border: 0'
    return HTML(f'<iframe srcdoc="{html.escape(page)}" style="{style}"></iframe>')
