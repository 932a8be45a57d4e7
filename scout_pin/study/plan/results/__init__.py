"""What a plan comes to: reports, words, JSON, gaits and tables of joints."""
