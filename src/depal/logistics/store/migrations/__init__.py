"""The steps from older tables of the store's data to those of this depal."""
