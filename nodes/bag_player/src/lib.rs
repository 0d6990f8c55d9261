//! TEMPORARY skeleton of bag_player.
