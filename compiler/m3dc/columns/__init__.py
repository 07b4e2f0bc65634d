"""What the tables of the IR are made of: columns, and the rows that are added to them."""
