/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * PCL has a function for it, in a library that brings VTK and fifty others into the
 * process: a tenth of its time where clouds are small.
 */

namespace tool {

/** \brief Decompress what LZF has compressed, whatever the data are.
 * \param[in] from,from_size the compressed bytes
 * \param[out] to,to_size take the bytes
 * \return whether the data are right and make so many bytes
 */
bool
decompressLZF(const std::uint8_t* from,
              std::size_t from_size,
              std::uint8_t* to,
              std::size_t to_size);

/** \brief Compress bytes with LZF, in a time that is linear in their number.
 * \return the compressed bytes, which may be a little more where nothing repeats
 */
std::vector<std::uint8_t>
compressLZF(const std::uint8_t* from, std::size_t size);

} // namespace tool
