"""What a reader of a page sees, for tests."""

import re
from html.parser import HTMLParser

SHOWN = ("alt", "aria-label", "content", "data-label")  # attributes that are read out or drawn
APART = ("code", "script", "style")  # names of files and code
LINE, LINES = 95, 5  # characters, of a caption at 1280 pixels
RAW = re.compile(r"\w_\w|\S?\^\S?")


class _Shown(HTMLParser):
    """Texts and attributes that a page shows, each with the elements that it stands in."""

    def __init__(self, page):
        super().__init__()
        self.open, self.texts = [], []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if attributes.get("http-equiv") is None and attributes.get("name") != "viewport":
            self.texts += [([tag], attributes[name]) for name in SHOWN if name in attributes]
        if tag not in ("meta", "link", "img", "br", "wbr"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        self.open.pop()

    def handle_data(self, data):
        if not set(self.open) & set(APART):
            self.texts.append((list(self.open), data))


def find_raw_symbols(page):
    """Texts with symbols that nobody set, such as l_a or m^0.4."""
    return [text for _, text in _Shown(page).texts if RAW.search(text)]


def find_long_captions(page):
    """Captions of tables and figures that take more than five lines before they are unfolded."""
    captions, inside = [], False
    for elements, text in _Shown(page).texts:
        now = "caption" in elements or "figcaption" in elements
        if now and not inside:
            captions.append("")
        if now and "details" not in elements:
            captions[-1] += text
        inside = now
    found = [" ".join(caption.split()) for caption in captions]
    return [caption for caption in found if len(caption) > LINE * LINES]
