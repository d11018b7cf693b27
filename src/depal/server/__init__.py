"""The store's side of a cell: use cases with roles, the HTTP API and the operator's screen."""
