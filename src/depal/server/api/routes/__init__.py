"""The routes of the API, each for one use case."""
