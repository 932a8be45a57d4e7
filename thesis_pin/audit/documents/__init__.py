"""What an audit says, to people and machines: tables, JSON, Markdown, a page."""
