"""What a motion is judged by."""
