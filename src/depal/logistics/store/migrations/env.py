"""Alembic runs the steps over a connection that depal has opened."""

from alembic import context

from depal.logistics.store.served_tables import QueuedRow

connection = context.config.attributes["connection"]
context.configure(connection=connection, target_metadata=QueuedRow.metadata, render_as_batch=True)
context.run_migrations()
