"""What a reader of a page sees, for tests, and jobs of the rules that write pages."""

import re
from html.parser import HTMLParser
from types import SimpleNamespace

SHOWN = ("alt", "aria-label", "content", "data-label")  # attributes that are read out or drawn
APART = ("code", "script", "style")  # names of files and code
RAW = re.compile(r"\w_\w|\S?\^\S?")
UNFILLED = re.compile(r"\bnan\b|\bundefined\b|= None\b|^None$")
VOID = {"meta", "link", "img", "br", "wbr", "input", "hr"}


class Files(dict):
    """Paths of a job by name."""

    __getattr__ = dict.__getitem__

    def __getitem__(self, key):
        return next(iter(self.values())) if key == 0 else super().__getitem__(key)


def make_job(inputs, outputs, wildcards=(), **params):
    """A job as Snakemake gives it to a script."""
    return SimpleNamespace(
        input=Files(inputs),
        output=Files(outputs),
        wildcards=SimpleNamespace(**dict(wildcards)),
        params=SimpleNamespace(**params),
    )


class Page(HTMLParser):
    """Nesting errors, tags with their attributes, and texts of a page."""

    def __init__(self, html):
        super().__init__()
        self.html = html
        self.open, self.errors, self.tags, self.shown = [], [], [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.tags.append((tag, attributes))
        if attributes.get("http-equiv") is None and attributes.get("name") != "viewport":
            self.shown += [attributes[name] for name in SHOWN if name in attributes]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.errors.append((tag, self.getpos()))

    def handle_data(self, data):
        if not set(self.open) & {*APART, "title"}:
            self.shown.append(data)

    @property
    def text(self):
        """All that is shown, with plain spaces."""
        return " ".join(" ".join(self.shown).split()).replace("\u00a0", " ")

    @property
    def links(self):
        return [attributes["href"] for tag, attributes in self.tags if tag == "a"]

    def check(self, *words):
        """The page is well-formed, leads somewhere, fetches nothing, and shows these words."""
        assert not self.errors
        assert not self.open
        identities = [attributes["id"] for _, attributes in self.tags if "id" in attributes]
        assert len(identities) == len(set(identities))
        assert {link[1:] for link in self.links if link.startswith("#")} <= set(identities)
        odd = [text for text in self.shown if RAW.search(text) or UNFILLED.search(text)]
        assert not odd, odd
        for tag, attributes in self.tags:
            assert tag != "script" or "src" not in attributes
            for name in ("src", "srcset", "href", "data"):
                address = attributes.get(name, "")
                outside = re.match(r"\w+:", address)
                doi = tag == "a" and address.startswith("https://doi.org/10.")
                assert not outside or doi or address.startswith("data:"), address
        assert [word for word in words if word not in self.text] == []
