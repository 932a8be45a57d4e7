"""The torque report of any robot: numbers, verdict, documents, curves, figures."""
