"""The balance report of any robot on its feet: numbers, verdict, documents, curves, figures."""
