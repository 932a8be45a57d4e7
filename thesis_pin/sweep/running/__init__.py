"""Who judges designs, and where the rows go: processes, a Dask cluster, a folder of parts."""
