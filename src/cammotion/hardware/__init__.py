"""What is made of metal: the cam, the indexer, fits.

It takes laws and motions as they are, and answers with sizes, torques and inertias.
"""
