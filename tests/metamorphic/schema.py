"""The schema of model files, as `hersey schema` prints it, walked along a model."""

import json
import subprocess


class Schema:
    def __init__(self, program):
        self.root = json.loads(subprocess.run([program, "schema"], capture_output=True, text=True, check=True).stdout)

    def resolved(self, node):
        while "$ref" in node:
            target = self.root
            for part in node["$ref"].split("/")[1:]:
                target = target[part]
            node = {key: value for key, value in node.items() if key != "$ref"} | target
        return node

    def forms(self, node):
        """The node and everything that may stand in its place."""
        node = self.resolved(node)
        yield node
        for word in ("anyOf", "oneOf", "allOf"):
            for choice in node.get(word, ()):
                if not choice.get("$ref", "").endswith("/parameter"):
                    yield from self.forms(choice)

    def below(self, nodes, key):
        """What the schema says of a key, or of an entry of a list, of any of these nodes."""
        for node in nodes:
            for form in self.forms(node):
                if isinstance(key, int):
                    found = form.get("items")
                else:
                    found = form.get("properties", {}).get(key) or form.get("additionalProperties")
                if isinstance(found, dict):
                    yield found

    def mappings(self, tree, nodes=None, path=()):
        """(path, mapping, schema nodes) of every mapping of a model."""
        nodes = nodes if nodes is not None else [self.root]
        if isinstance(tree, dict):
            yield path, tree, nodes
        items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
        for key, value in items:
            yield from self.mappings(value, list(self.below(nodes, key)), (*path, key))

    def properties(self, nodes):
        """{key: schema nodes} that a mapping may have, own names left out."""
        found = {}
        for node in nodes:
            for form in self.forms(node):
                for key, value in form.get("properties", {}).items():
                    if key != "use":
                        found.setdefault(key, []).append(value)
        return found

    def defaults_left_out(self, tree):
        """(path, default) of every key that a model could write out and does not."""
        for path, mapping, nodes in self.mappings(tree):
            for key, values in self.properties(nodes).items():
                if key in mapping:
                    continue
                for default in dict.fromkeys(str(v["default"]) for v in map(self.resolved, values) if "default" in v):
                    yield (*path, key), default
