"""A thesis's errata as a document for its author, in English or Spanish."""
